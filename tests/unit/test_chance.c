/* SPDX-License-Identifier: MIT */
#include "chance.h"

#include <math.h>

#include "unity.h"

static chance_t chance;

void setUp(void) {
    chance_begin(&chance, 1, 0);
}

void tearDown(void) {
}

/* The authors' own example: the state 1, 2, 3, 4. */
static void test_bits_are_those_of_xoshiro256(void) {
    static const uint64_t expected[] = {11520u, 0u, 1509978240u, 1215971899390074240u};
    const chance_t example = {{1, 2, 3, 4}};
    chance = example;
    for (unsigned index = 0; index < 4; index++) {
        TEST_ASSERT_EQUAL_UINT64(expected[index], chance_bits(&chance));
    }
}

/* splitmix64 and xoshiro256** in Python's integers:
 *     state += 0x9E3779B97F4A7C15; z = state; z = (z ^ z >> 30)*0xBF58476D1CE4E5B9; ... mod 2^64
 * started from seed + stream*2^32. */
static void test_seed_and_stream_give_their_own_bits(void) {
    static const struct {
        uint32_t seed;
        uint32_t stream;
        uint64_t first;
        uint64_t second;
    } vectors[] = {
        {1u, 0u, UINT64_C(0xB3F2AF6D0FC710C5), UINT64_C(0x853B559647364CEA)},
        {1u, 1u, UINT64_C(0x22E65890AAED82DC), UINT64_C(0x89B053BE299BD377)},
        {0u, 0u, UINT64_C(0x99EC5F36CB75F2B4), UINT64_C(0xBF6E1F784956452A)},
        {4294967295u, 3u, UINT64_C(0xD6B523ADCC6ECF02), UINT64_C(0xF4732F71CC78BF51)},
    };
    for (size_t index = 0; index < sizeof vectors / sizeof vectors[0]; index++) {
        chance_begin(&chance, vectors[index].seed, vectors[index].stream);
        TEST_ASSERT_EQUAL_UINT64(vectors[index].first, chance_bits(&chance));
        TEST_ASSERT_EQUAL_UINT64(vectors[index].second, chance_bits(&chance));
    }
}

/* The same Python, (bits >> 11)*2.0**-53: exact. */
static void test_shares_are_the_upper_53_bits(void) {
    static const double expected[] = {0x1.67e55eda1f8e2p-1, 0x1.0a76ab2c8e6c9p-1,
                                      0x1.25f12eac10548p-1};
    for (unsigned index = 0; index < 3; index++) {
        TEST_ASSERT_TRUE(fabs(chance_share(&chance) - expected[index]) <= 0.0);
    }
}

/* Karney's algorithm N written a second time in Python: only sums, products and one quotient of
 * doubles, so exact on every machine. */
static void test_normal_deviates_are_the_same_on_every_machine(void) {
    static const double expected[] = {-0x1.da59042524c3cp-2, -0x1.b20df58ddff90p-3,
                                      0x1.814d4a1d3a998p+0,  -0x1.cc5a9210900eep-1,
                                      -0x1.9f1ef077eeb30p-3, 0x1.481fc9c270faep+1};
    for (unsigned index = 0; index < 6; index++) {
        TEST_ASSERT_TRUE(fabs(chance_normal(&chance) - expected[index]) <= 0.0);
    }
}

static void test_events_of_an_exponential_are_as_frequent_as_they_should_be(void) {
    enum { DRAWS = 100000 };
    static const double exponents[] = {0.0, 0.25, 0.5, 1.0};
    for (unsigned index = 0; index < 4; index++) {
        int events = 0;
        for (int draw = 0; draw < DRAWS; draw++) {
            events += chance_exponential(&chance, exponents[index]) ? 1 : 0;
        }
        /* four standard deviations of the mean of so many draws, at most 1/2 each: 0.0063 */
        TEST_ASSERT_DOUBLE_WITHIN(0.0063, exp(-exponents[index]), (double)events / DRAWS);
    }
}

static void test_normal_deviates_have_the_moments_and_tails_of_the_normal_distribution(void) {
    enum { DRAWS = 200000 };
    double sum = 0.0;
    double squares = 0.0;
    double fourths = 0.0;
    int beyond_two = 0;
    for (int draw = 0; draw < DRAWS; draw++) {
        const double deviate = chance_normal(&chance);
        sum += deviate;
        squares += deviate * deviate;
        fourths += deviate * deviate * deviate * deviate;
        beyond_two += fabs(deviate) > 2.0 ? 1 : 0;
    }
    /* four standard deviations: sqrt(1, 2, 96 and 0.0434)/sqrt(200000) times 4 */
    TEST_ASSERT_DOUBLE_WITHIN(0.009, 0.0, sum / DRAWS);
    TEST_ASSERT_DOUBLE_WITHIN(0.013, 1.0, squares / DRAWS);
    TEST_ASSERT_DOUBLE_WITHIN(0.088, 3.0, fourths / DRAWS);
    TEST_ASSERT_DOUBLE_WITHIN(0.0019, erfc(sqrt(2.0)), (double)beyond_two / DRAWS);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_bits_are_those_of_xoshiro256);
    RUN_TEST(test_seed_and_stream_give_their_own_bits);
    RUN_TEST(test_shares_are_the_upper_53_bits);
    RUN_TEST(test_normal_deviates_are_the_same_on_every_machine);
    RUN_TEST(test_events_of_an_exponential_are_as_frequent_as_they_should_be);
    RUN_TEST(test_normal_deviates_have_the_moments_and_tails_of_the_normal_distribution);
    return UNITY_END();
}
