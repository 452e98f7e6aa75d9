/* SPDX-License-Identifier: MIT */
#include "belt/integrity.h"

#include <string.h>

#include "reals.h"
#include "unity.h"

#define WORDS 16

static uint32_t block[WORDS];

void setUp(void) {
    uint64_t random = 41u;
    for (size_t i = 0; i < WORDS; ++i) {
        block[i] = (uint32_t)(random_bits(&random) >> 32);
    }
}

void tearDown(void) {
}

static void test_nothing_sums_to_nothing(void) {
    TEST_ASSERT_EQUAL_HEX32(0u, belt_integrity_sum(block, 0));
}

static void test_one_word_is_its_own_sum(void) {
    const uint32_t word = 0x12345678u;
    TEST_ASSERT_EQUAL_HEX32(0x12345678u, belt_integrity_sum(&word, sizeof word));
}

static void test_words_are_added(void) {
    const uint32_t words[] = {1u, 0x100u, 0x10000u, 0x1000000u};
    TEST_ASSERT_EQUAL_HEX32(0x01010101u, belt_integrity_sum(words, sizeof words));
}

static void test_sum_wraps(void) {
    const uint32_t words[] = {0xFFFFFFFFu, 0xFFFFFFFFu, 5u};
    TEST_ASSERT_EQUAL_HEX32(3u, belt_integrity_sum(words, sizeof words)); /* -1 - 1 + 5 */
}

static void test_every_number_of_words_is_added(void) {
    uint32_t sum = 0;
    for (size_t count = 0; count <= WORDS; ++count) {
        TEST_ASSERT_EQUAL_HEX32(sum, belt_integrity_sum(block, count * sizeof block[0]));
        sum += (count < WORDS) ? block[count] : 0u;
    }
}

static void test_words_behind_the_size_do_not_count(void) {
    const uint32_t before = belt_integrity_sum(block, sizeof block - sizeof block[0]);
    block[WORDS - 1] += 1u;
    TEST_ASSERT_EQUAL_HEX32(before, belt_integrity_sum(block, sizeof block - sizeof block[0]));
    TEST_ASSERT_EQUAL_HEX32(before + block[WORDS - 1], belt_integrity_sum(block, sizeof block));
}

static void test_any_one_flipped_bit_changes_the_sum_by_its_own_worth(void) {
    const uint32_t whole = belt_integrity_sum(block, sizeof block);
    for (size_t word = 0; word < WORDS; ++word) {
        for (unsigned bit = 0; bit < 32u; ++bit) {
            const uint32_t worth = (uint32_t)1 << bit;
            const bool is_set = (block[word] & worth) != 0u;
            block[word] ^= worth;
            TEST_ASSERT_EQUAL_HEX32(is_set ? whole - worth : whole + worth,
                                    belt_integrity_sum(block, sizeof block));
            block[word] ^= worth;
        }
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_nothing_sums_to_nothing);
    RUN_TEST(test_one_word_is_its_own_sum);
    RUN_TEST(test_words_are_added);
    RUN_TEST(test_sum_wraps);
    RUN_TEST(test_every_number_of_words_is_added);
    RUN_TEST(test_words_behind_the_size_do_not_count);
    RUN_TEST(test_any_one_flipped_bit_changes_the_sum_by_its_own_worth);
    return UNITY_END();
}
