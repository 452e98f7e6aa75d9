/* SPDX-License-Identifier: MIT */
#include "promises.h"

#include <string.h>

#include "belt/safety.h"
#include "model.h"

/** Starts a controller and lets it take the scenario's first level and belt. */
static bool start(belt_controller_t *controller, const scenario_t *scenario,
                  const belt_config_t *config) {
    static belt_real_t density[BELT_NODE_CAPACITY + 1];
    const bool is_measured = scenario->controller.density == DENSITY_MEASURED;
    const profile_t *profile =
        is_measured ? &scenario->initial.density : &scenario->initial.observer_density;
    belt_measurement_t measurement;
    belt_command_t command;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_DENSITY;
    measurement.level = model_real(scenario->initial.buffer_level);
    measurement.density = density;
    for (size_t i = 0; i <= config->node_count; ++i) {
        density[i] = model_real(profile_at(profile, (double)i / (double)config->node_count, 1.0));
    }
    return (belt_init(controller, config) == BELT_OK) &&
           (belt_step(controller, &measurement, &command) == BELT_OK);
}

static void print(const belt_promise_t *promise, const char *name, const char *unit, FILE *out) {
    const char *verdict = "promises nothing";
    if (!promise->applies) {
        verdict = "does not apply to this state";
    } else if (promise->holds) {
        verdict = "promises a positive inlet flux";
    }
    fprintf(out,
            "  %s: %s; %.6g must be below %.6g %s, margin %.6g (u %.6g parts/s, M %.6g parts/m)\n",
            name, verdict, (double)promise->left, (double)promise->right, unit,
            (double)promise->margin, (double)promise->flux_min, (double)promise->density_max);
}

void promises_report(const scenario_t *scenario, const belt_config_t *config, FILE *out) {
    static belt_controller_t controller; /* too large for the stack */
    belt_safety_t safety;
    fprintf(out, "advice, no rule: is it certain that the law, before limits, always asks for more "
                 "than nothing?\n");
    if (!start(&controller, scenario, config) ||
        (belt_safety_assess(&controller, &safety) != BELT_OK)) {
        fprintf(
            out,
            "  the controller does not take the state at the start as it is: nothing to judge\n");
        return;
    }
    print(&safety.proposition, "Proposition 2", "s/m", out);
    print(&safety.sharper, "sharper bound", "parts/s", out);
    fprintf(out,
            "  jump at the inlet: %.6g parts/m (density there less what the law asks for; 0: no "
            "front)\n",
            (double)safety.jump);
}
