/* SPDX-License-Identifier: MIT */
#include "check.h"

#include <string.h>

#include "equilibrium.h"
#include "model.h"
#include "promises.h"

/* Whose laws controller and plant have; what is left out is the paper's. */
#ifdef BELT_LINE_LAWS
#define CONTROLLER_LAWS BELT_LINE_LAWS
#else
#define CONTROLLER_LAWS "the paper's"
#endif
#ifdef SIM_LINE_LAWS
#define PLANT_LAWS SIM_LINE_LAWS
#else
#define PLANT_LAWS "the paper's"
#endif

static void print_laws(FILE *out) {
    const char *const of_controller = CONTROLLER_LAWS;
    const char *const of_plant = PLANT_LAWS;
    if (strcmp(of_controller, of_plant) != 0) {
        fprintf(out, "laws of the line: the controller's %s, the plant's %s\n", of_controller,
                of_plant);
    }
}

bool check_report(const scenario_t *scenario, FILE *out) {
    belt_config_t config;
    model_config(scenario, &config);
    fprintf(out, "%s\nrules of the controller's configuration:\n", scenario->name);
    int broken = model_print_rules(&config, out);
    for (size_t i = 0; i < scenario->run.setpoints.count; ++i) {
        broken += model_refuses_setpoint(scenario, i, out) ? 1 : 0;
    }
    if (broken > 0) {
        fprintf(out, "%d broken: the controller would refuse this scenario\n", broken);
        return false;
    }
    const line_t *line = &scenario->line;
    const equilibrium_t rest = equilibrium_of(line, scenario->law.level_setpoint);
    const double empty = line->processing_time * line->belt_length;
    fprintf(out,
            "dead time: %.6g s empty, %.6g s at the set-point, %.6g s full (%.1f, %.1f, %.1f "
            "periods)\n",
            empty, rest.dead_time, (double)belt_config_dead_time_max(&config),
            empty / scenario->controller.period, rest.dead_time / scenario->controller.period,
            (double)belt_config_dead_time_max(&config) / scenario->controller.period);
    print_laws(out);
    belt_nominal_law_t law;
    belt_nominal_law_init(&law, &config);
    fprintf(out, "law: slope %.6g 1/s, gains %.6g below and %.6g above 1/parts\n",
            (double)belt_config_slope(&config), (double)law.gains.below, (double)law.gains.above);
    fprintf(out, "estimator: %s, time constant %.6g s%s\n",
            (config.estimator == BELT_ESTIMATOR_ON) ? "on" : "off",
            (double)belt_config_estimator_time(&config),
            (config.estimator_time > BELT_REAL(0)) ? "" : " by the rule");
    fprintf(out,
            "equilibrium: level %.6g parts, outlet flux %.6g parts/s, inlet flux %.6g parts/s, "
            "density %.6g (outlet) to %.6g (inlet) parts/m\n",
            scenario->law.level_setpoint, rest.outlet_flux, rest.inlet_flux, rest.outlet_density,
            rest.inlet_density);
    if (scenario->controller.inlet_flux_max < rest.inlet_flux) {
        fprintf(out,
                "note: controller.inlet_flux_max %.6g is below that inlet flux: the set-point "
                "cannot be held\n",
                scenario->controller.inlet_flux_max);
    }
    promises_report(scenario, &config, out);
    return true;
}
