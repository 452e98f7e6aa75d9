/* SPDX-License-Identifier: MIT */
/*
 * readings.h - what arrives from the sensors in one period.
 */
#ifndef HOST_SIM_READINGS_H
#define HOST_SIM_READINGS_H

#include <stddef.h>

#include "channel.h"

typedef struct {
    signal_t level;        /**< [parts]. */
    signal_t outlet_flux;  /**< [parts/s]. */
    signal_t applied_flux; /**< what the valve let through in the last period [parts/s]. */
    signal_t density;      /**< node_count + 1 of them, outlet to inlet [parts/m]. */
} readings_t;

#endif
