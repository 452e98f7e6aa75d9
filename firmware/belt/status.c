/* SPDX-License-Identifier: MIT */
#include "types.h"

const char *belt_status_name(belt_status_t status) {
    const char *name = "BELT_UNKNOWN_STATUS";
    switch (status) {
        case BELT_OK: name = "BELT_OK"; break;
        case BELT_BELT_LENGTH: name = "BELT_BELT_LENGTH"; break;
        case BELT_PROCESSING_TIME: name = "BELT_PROCESSING_TIME"; break;
        case BELT_SPEED_WINDOW: name = "BELT_SPEED_WINDOW"; break;
        case BELT_CONGESTION_SCALE: name = "BELT_CONGESTION_SCALE"; break;
        case BELT_CONNECTIVITY: name = "BELT_CONNECTIVITY"; break;
        case BELT_SERVICE_RATE_MAX: name = "BELT_SERVICE_RATE_MAX"; break;
        case BELT_SERVICE_TIME: name = "BELT_SERVICE_TIME"; break;
        case BELT_LEVEL_CAPACITY: name = "BELT_LEVEL_CAPACITY"; break;
        case BELT_REWORK_RATE: name = "BELT_REWORK_RATE"; break;
        case BELT_LOSS_COUNT: name = "BELT_LOSS_COUNT"; break;
        case BELT_LOSS_RATE: name = "BELT_LOSS_RATE"; break;
        case BELT_NODE_COUNT: name = "BELT_NODE_COUNT"; break;
        case BELT_PERIOD: name = "BELT_PERIOD"; break;
        case BELT_PERIOD_PER_NODE: name = "BELT_PERIOD_PER_NODE"; break;
        case BELT_WINDOW_SHORT: name = "BELT_WINDOW_SHORT"; break;
        case BELT_WINDOW_LONG: name = "BELT_WINDOW_LONG"; break;
        case BELT_DEAD_TIME: name = "BELT_DEAD_TIME"; break;
        case BELT_LOSS_EXPONENT: name = "BELT_LOSS_EXPONENT"; break;
        case BELT_LOSS_PER_NODE: name = "BELT_LOSS_PER_NODE"; break;
        case BELT_REWORK_PER_NODE: name = "BELT_REWORK_PER_NODE"; break;
        case BELT_REWORK_GAIN: name = "BELT_REWORK_GAIN"; break;
        case BELT_SERVICE_PER_NODE: name = "BELT_SERVICE_PER_NODE"; break;
        case BELT_CONGESTION_PER_NODE: name = "BELT_CONGESTION_PER_NODE"; break;
        case BELT_NOMINAL_FLUX_MAX: name = "BELT_NOMINAL_FLUX_MAX"; break;
        case BELT_LEVEL_SETPOINT: name = "BELT_LEVEL_SETPOINT"; break;
        case BELT_SLOPE_KIND: name = "BELT_SLOPE_KIND"; break;
        case BELT_SETPOINT_SLOPE: name = "BELT_SETPOINT_SLOPE"; break;
        case BELT_PERIOD_PER_SLOPE: name = "BELT_PERIOD_PER_SLOPE"; break;
        case BELT_INLET_FLUX_MAX: name = "BELT_INLET_FLUX_MAX"; break;
        case BELT_PREDICTION_KIND: name = "BELT_PREDICTION_KIND"; break;
        case BELT_ESTIMATOR_KIND: name = "BELT_ESTIMATOR_KIND"; break;
        case BELT_ESTIMATOR_TIME: name = "BELT_ESTIMATOR_TIME"; break;
        case BELT_FLUX_RATE_MAX: name = "BELT_FLUX_RATE_MAX"; break;
        case BELT_SUBSTITUTE_FLUX: name = "BELT_SUBSTITUTE_FLUX"; break;
        case BELT_LEVEL_STEP_MAX: name = "BELT_LEVEL_STEP_MAX"; break;
        case BELT_TRANSFER_TIME: name = "BELT_TRANSFER_TIME"; break;
        case BELT_MISUSE: name = "BELT_MISUSE"; break;
        case BELT_NO_LEVEL: name = "BELT_NO_LEVEL"; break;
        case BELT_INPUT_REJECTED: name = "BELT_INPUT_REJECTED"; break;
        case BELT_PERIODS_MISSED: name = "BELT_PERIODS_MISSED"; break;
        case BELT_LINE_DEVIATES: name = "BELT_LINE_DEVIATES"; break;
        case BELT_CORRUPT: name = "BELT_CORRUPT"; break;
        case BELT_UNKNOWN_MODE: name = "BELT_UNKNOWN_MODE"; break;
        case BELT_NOT_MANUAL: name = "BELT_NOT_MANUAL"; break;
        case BELT_MANUAL_FLUX: name = "BELT_MANUAL_FLUX"; break;
        case BELT_NO_SNAPSHOT: name = "BELT_NO_SNAPSHOT"; break;
        case BELT_SNAPSHOT_OLD: name = "BELT_SNAPSHOT_OLD"; break;
    }
    return name;
}
