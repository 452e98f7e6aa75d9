/* SPDX-License-Identifier: MIT */
/*
 * fault.h - what goes wrong in a run, on which signal and when: `signal:word[=value]@start+length`.
 *
 *                    a measured signal              valve                   period
 *   off              does not arrive                closed                  power cut, see below
 *   stuck            stays, no new sample           stays where it is       the task hangs
 *   garbage          random bits in every number    -                       elapsed_ticks 0 ... 200
 *   wrong=factor     times the factor               times the factor        elapsed_ticks times it
 *   slow=time        lags behind, of first order    the same                -
 *   delayed=time     arrives so much later          obeys so much later     -
 *   intermittent=share   that share does not arrive     ... of the commands     ... of the steps
 *
 * Signals are buffer_level, outlet_flux, applied_flux, density (each as the controller gets it), valve
 * and period. A fault is at work in the periods that start in [start, start + length). Faults of one
 * signal are passed in the order in which they are stated.
 *
 * A delayed signal stands still until its delay has passed: nothing older than what came before
 * arrives. In a power cut no step runs, the valve is closed and the controller's memory is lost; at its
 * end the controller starts again from its last snapshot. While a task hangs, and in a lost step, the
 * last command stays applied, and the next step is told how many periods have passed.
 */
#ifndef HOST_SIM_FAULT_H
#define HOST_SIM_FAULT_H

#include <stdbool.h>
#include <stddef.h>

/** Most faults in one run. */
#define FAULT_CAPACITY 32
/** Longest delay in periods: what is under way must be kept. */
#define FAULT_DELAY_PERIODS 10000.0
/** Greatest elapsed_ticks that a fault makes up. */
#define FAULT_TICKS_MAX 200

typedef enum {
    FAULT_ON_BUFFER_LEVEL,
    FAULT_ON_OUTLET_FLUX,
    FAULT_ON_APPLIED_FLUX,
    FAULT_ON_DENSITY,
    FAULT_ON_VALVE,
    FAULT_ON_PERIOD
} fault_signal_t;
#define FAULT_SIGNALS "buffer_level outlet_flux applied_flux density valve period"

typedef enum {
    FAULT_OFF,
    FAULT_STUCK,
    FAULT_GARBAGE,
    FAULT_WRONG,
    FAULT_SLOW,
    FAULT_DELAYED,
    FAULT_INTERMITTENT
} fault_word_t;
#define FAULT_WORDS "off stuck garbage wrong slow delayed intermittent"

typedef struct {
    fault_signal_t signal;
    fault_word_t word;
    double value;  /**< factor, time [s] or share; 0 for words without one. */
    double start;  /**< [s]. */
    double length; /**< [s]. */
} fault_t;

/** Whether it is at work in period `index`. */
bool fault_is_active(const fault_t *fault, size_t index, double period);

/** Start of the last power cut among `count` faults, less than 0 when there is none [s]. */
double fault_last_cut(const fault_t *faults, size_t count);

#endif
