/* SPDX-License-Identifier: MIT */
#include "exponential.h"

/* ln 2 in two parts: the first has zeros at its end, so that k*LN2_HIGH is exact for small k. */
#if BELT_REAL_IS_DOUBLE
#define TERMS 13
#define VANISHING 40
#define LN2_HIGH BELT_REAL(6.93147180369123816490e-01)
#define LN2_LOW BELT_REAL(1.90821492927058770002e-10)
#else
#define TERMS 8
#define VANISHING 20
#define LN2_HIGH BELT_REAL(0.693145751953125)
#define LN2_LOW BELT_REAL(1.42860676533018704e-06)
#endif
#define LOG2_E BELT_REAL(1.44269504088896340736)

/** 1/n!, n = 1 ... TERMS: on |r| <= ln(2)/2 the rest of the series is below half a unit. */
static const belt_real_t inverse_factorial[13] = {
    BELT_REAL(1),
    BELT_REAL(1) / BELT_REAL(2),
    BELT_REAL(1) / BELT_REAL(6),
    BELT_REAL(1) / BELT_REAL(24),
    BELT_REAL(1) / BELT_REAL(120),
    BELT_REAL(1) / BELT_REAL(720),
    BELT_REAL(1) / BELT_REAL(5040),
    BELT_REAL(1) / BELT_REAL(40320),
    BELT_REAL(1) / BELT_REAL(362880),
    BELT_REAL(1) / BELT_REAL(3628800),
    BELT_REAL(1) / BELT_REAL(39916800),
    BELT_REAL(1) / BELT_REAL(479001600),
    BELT_REAL(1) / BELT_REAL(6227020800.0),
};

/* exp(-VANISHING) needs at most 3/2*VANISHING halvings. */
BELT_STATIC_ASSERT(powers_of_two_fit_a_word, 3 * VANISHING <= 2 * BELT_QUANTA_BITS);

belt_real_t belt_expm1(belt_real_t x) {
    if (!(x < BELT_REAL(0))) {
        return BELT_REAL(0);
    }
    if (x < -BELT_REAL(VANISHING)) {
        return BELT_REAL(-1);
    }
    /* x = r - halvings*ln 2 with |r| <= ln(2)/2. */
    const int32_t halvings = (int32_t)(BELT_HALF - x * LOG2_E);
    const belt_real_t count = (belt_real_t)halvings;
    const belt_real_t r = (x + count * LN2_HIGH) + count * LN2_LOW;

    belt_real_t series = inverse_factorial[TERMS - 1];
    for (int n = TERMS - 2; n >= 1; --n) {
        series = series * r + inverse_factorial[n];
    }
    series = r + r * r * series;

    const belt_real_t scale = BELT_REAL(1) / (belt_real_t)((belt_word_t)1 << halvings);
    return scale * series + (scale - BELT_REAL(1));
}
