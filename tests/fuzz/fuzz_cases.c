/* SPDX-License-Identifier: MIT */
#include "fuzz_cases.h"

#include "fuzz_input.h"

/* Every error bit that measurement.h has. */
#define ALL_ERROR_BITS 0x7FFFu

static belt_config_t paper(void) {
    belt_config_t config;
    memset(&config, 0, sizeof config);
    config.belt_length = BELT_REAL(2);
    config.processing_time = BELT_REAL(0.25);
    config.speed_window = BELT_REAL(0.2);
    config.congestion_scale = BELT_REAL(1);
    config.connectivity = BELT_REAL(0.5);
    config.service_rate_max = BELT_REAL(0.8);
    config.service_time = BELT_REAL(1);
    config.level_capacity = BELT_REAL(1);
    config.rework_rate = BELT_REAL(0.1);
    config.loss_rate[0] = BELT_REAL(1);
    config.loss_count = 1;
    config.level_setpoint = BELT_REAL(0.3);
    config.nominal_flux_max = BELT_REAL(1.2);
    config.slope_kind = BELT_SLOPE_MARGIN;
    config.slope = BELT_REAL(20);
    config.node_count = 20;
    config.period = BELT_REAL(0.0025);
    config.inlet_flux_max = BELT_NO_FLUX_LIMIT;
    config.prediction = BELT_PREDICT_CONGESTION;
    return config;
}

belt_config_t fuzz_case(unsigned index) {
    belt_config_t config = paper();
    switch (index) {
        case 1u:
            config.node_count = 4;
            config.loss_rate[0] = BELT_REAL(0.25);
            config.congestion_scale = BELT_REAL(2);
            config.period = BELT_REAL(0.1);
            config.slope = BELT_REAL(2);
            config.inlet_flux_max = BELT_REAL(2.5);
            config.flux_rate_max = BELT_REAL(5);
            config.substitute_flux = BELT_REAL(0.5);
            config.hold_periods = 2;
            config.recovery_samples = 2;
            break;
        case 2u:
            config.node_count = 9;
            config.loss_count = 3;
            config.loss_rate[0] = BELT_REAL(0.4);
            config.loss_rate[1] = BELT_REAL(1.2);
            config.loss_rate[2] = BELT_REAL(0);
            config.period = BELT_REAL(0.05);
            config.slope = BELT_REAL(10);
            config.estimator = BELT_ESTIMATOR_ON;
            break;
        case 3u:
            config.speed_window = BELT_REAL(3);
            config.period = BELT_REAL(0.025);
            config.estimator = BELT_ESTIMATOR_ON;
            config.sample_periods = 2;
            config.prediction = BELT_HOLD_CONGESTION;
            break;
        default: break;
    }
    return config;
}

void fuzz_spoil_command(belt_command_t *command) {
    memset(command, 0xA5, sizeof *command);
}

void fuzz_check_command(const belt_command_t *command, belt_real_t inlet_flux_max) {
    FUZZ_CHECK(fuzz_is_finite(command->inlet_flux));
    FUZZ_CHECK(command->inlet_flux >= BELT_REAL(0));
    FUZZ_CHECK(command->inlet_flux <= inlet_flux_max);
    FUZZ_CHECK((uint32_t)command->mode < BELT_MODE_COUNT);
    FUZZ_CHECK((command->error_bits & ~ALL_ERROR_BITS) == 0u);
}

void fuzz_check_controller(const belt_controller_t *controller) {
    const belt_line_t *line = &controller->model.line;
    const belt_observer_t *observer = &controller->model.observer;
    /* The rework that comes back falls linearly to 0 at the inlet: but for its rounding. */
    const belt_real_t rounding = BELT_REAL_EPSILON * line->density_bound;
    for (uint32_t cell = 0; cell < line->cell_slots; ++cell) {
        FUZZ_CHECK(observer->density[cell] >= -rounding);
        FUZZ_CHECK(fuzz_is_finite(observer->density[cell]));
        FUZZ_CHECK(fuzz_is_finite(observer->step[cell]));
    }
    FUZZ_CHECK((observer->outlet_density >= BELT_REAL(0)) &&
               (observer->outlet_density <= line->density_bound));
    FUZZ_CHECK((observer->gone >= BELT_REAL(0)) && (observer->gone < BELT_REAL(1)));
    FUZZ_CHECK((controller->model.present.level >= BELT_REAL(0)) &&
               (controller->model.present.level <= line->level_capacity));
    FUZZ_CHECK(fuzz_is_finite(controller->model.present.congestion));
    FUZZ_CHECK((controller->model.estimator.level >= BELT_REAL(0)) &&
               (controller->model.estimator.level <= line->level_capacity));
    FUZZ_CHECK(fuzz_is_finite(controller->model.estimator.disturbance));
    FUZZ_CHECK(fuzz_is_finite(controller->supervisor.bump));
    const belt_prediction_t *prediction = &controller->prediction;
    FUZZ_CHECK((prediction->inlet.level >= BELT_REAL(0)) &&
               (prediction->inlet.level <= line->level_capacity));
    FUZZ_CHECK(fuzz_is_finite(prediction->inlet.arrival));
    FUZZ_CHECK(fuzz_is_finite(prediction->inlet_rework));
}
