/* SPDX-License-Identifier: MIT */
#include "operator.h"

#include "model.h"
#include "schedule.h"

/* The scenario's modes are the controller's first ones. */
BELT_STATIC_ASSERT(off_is_off, (int)MODE_OFF == (int)BELT_MODE_OFF);
BELT_STATIC_ASSERT(manual_is_manual, (int)MODE_MANUAL == (int)BELT_MODE_MANUAL);
BELT_STATIC_ASSERT(automatic_is_automatic, (int)MODE_AUTOMATIC == (int)BELT_MODE_AUTOMATIC);

void operator_begin(operator_t *self, const scenario_t *scenario) {
    const operator_t fresh = {scenario, 0, 0, 0, scenario->law.level_setpoint};
    *self = fresh;
}

static bool is_taken(const operator_t *self, const char *what, belt_status_t status,
                     FILE *messages) {
    if (status != BELT_OK) {
        fprintf(messages, "%s: the controller refuses the %s: %s\n", self->scenario->name, what,
                belt_status_name(status));
    }
    return status == BELT_OK;
}

static bool say_setpoint(const operator_t *self, belt_controller_t *controller, FILE *messages) {
    return is_taken(self, "set-point",
                    belt_set_setpoint(controller, model_real(self->level_setpoint)), messages);
}

static bool say_manual_flux(const operator_t *self, belt_controller_t *controller, double flux,
                            FILE *messages) {
    return is_taken(self, "manual flux", belt_set_manual_flux(controller, model_real(flux)),
                    messages);
}

static bool say_mode(const operator_t *self, belt_controller_t *controller, scenario_mode_t mode,
                     FILE *messages) {
    const bool sets_flux = (mode == MODE_MANUAL) && self->scenario->run.manual_flux_is_stated;
    return is_taken(self, "mode", belt_set_mode(controller, (belt_mode_t)mode), messages) &&
           (!sets_flux ||
            say_manual_flux(self, controller, self->scenario->run.manual_flux, messages));
}

static bool speak_setpoint(operator_t *self, belt_controller_t *controller, size_t index,
                           FILE *messages) {
    const schedule_t *const setpoints = &self->scenario->run.setpoints;
    const size_t due = schedule_come(setpoints->times, setpoints->count, self->setpoints_said,
                                     index, self->scenario->controller.period);
    bool is_said = true;
    for (; (self->setpoints_said < due) && is_said; ++self->setpoints_said) {
        self->level_setpoint = setpoints->values[self->setpoints_said];
        is_said = !model_refuses_setpoint(self->scenario, self->setpoints_said, messages) &&
                  say_setpoint(self, controller, messages);
    }
    return is_said;
}

/** Modes and the moves of the manual flux between them, in the order of their times; of two at the
 * same time the mode comes first. */
static bool speak_mode(operator_t *self, belt_controller_t *controller, size_t index,
                       FILE *messages) {
    const scenario_t *const scenario = self->scenario;
    const schedule_t *const manual = &scenario->run.manual;
    const double period = scenario->controller.period;
    const size_t modes = schedule_come(scenario->run.modes.times, scenario->run.modes.count,
                                       self->modes_said, index, period);
    const size_t moves =
        schedule_come(manual->times, manual->count, self->manual_said, index, period);
    bool is_said = true;
    while (is_said && ((self->modes_said < modes) || (self->manual_said < moves))) {
        const bool mode_is_next =
            (self->modes_said < modes) &&
            ((self->manual_said == moves) ||
             (scenario->run.modes.times[self->modes_said] <= manual->times[self->manual_said]));
        if (mode_is_next) {
            is_said =
                say_mode(self, controller, scenario->run.modes.words[self->modes_said], messages);
            self->modes_said += 1;
        } else {
            is_said =
                say_manual_flux(self, controller, manual->values[self->manual_said], messages);
            self->manual_said += 1;
        }
    }
    return is_said;
}

bool operator_speak(operator_t *self, belt_controller_t *controller, size_t index, FILE *messages) {
    return speak_setpoint(self, controller, index, messages) &&
           speak_mode(self, controller, index, messages);
}

bool operator_repeat(const operator_t *self, belt_controller_t *controller, FILE *messages) {
    const scenario_t *const scenario = self->scenario;
    if ((self->setpoints_said > 0) && !say_setpoint(self, controller, messages)) {
        return false;
    }
    if (self->modes_said == 0) {
        return true;
    }
    const scenario_mode_t mode = scenario->run.modes.words[self->modes_said - 1];
    const double since = scenario->run.modes.times[self->modes_said - 1];
    const bool was_moved =
        (self->manual_said > 0) && (scenario->run.manual.times[self->manual_said - 1] >= since);
    return say_mode(self, controller, mode, messages) &&
           ((mode != MODE_MANUAL) || !was_moved ||
            say_manual_flux(self, controller, scenario->run.manual.values[self->manual_said - 1],
                            messages));
}
