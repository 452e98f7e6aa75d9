/* SPDX-License-Identifier: MIT */
#include "scenario.h"

#include <string.h>

#include "scenario_ini.h"
#include "scenario_keys.h"
#include "scenario_message.h"
#include "scenario_rules.h"
#include "scenario_text.h"
#include "scenario_value.h"

/* Who stated a key last. */
typedef enum { BY_NOBODY, BY_DEFAULT, BY_FILE, BY_SETTING } author_t;

/* A scenario while it is read. */
typedef struct {
    scenario_t scenario;
    author_t author[SCENARIO_KEY_CAPACITY];
    size_t list_count[SCENARIO_KEY_CAPACITY]; /* as stated: in the scenario, times and values share
                                                 one count */
} draft_t;

/* Room for the section or the key of a setting; longer names are unknown anyway. */
#define SETTING_NAME_SIZE 64

/* Plant discretisations fine enough for 1e-5 (characteristics), and the paper's (upwind). */
static const struct {
    long node_count;
    long substeps;
} PLANT_DEFAULTS[] = {{400, 4}, {80, 1}};

static bool store(draft_t *draft, size_t index, const char *text, author_t author,
                  const scenario_place_t *place) {
    const scenario_key_t *const key = scenario_key_at(index);
    if (!scenario_value_store(key, text, place, &draft->scenario)) {
        return false;
    }
    for (size_t other = 0; other < scenario_key_count(); other++) {
        if (scenario_key_at(other)->offset == key->offset) {
            draft->author[other] = BY_NOBODY;
        }
    }
    draft->author[index] = author;
    draft->list_count[index] = scenario_value_count(key, &draft->scenario);
    return true;
}

static size_t find_key(const scenario_place_t *place, const scenario_entry_t *entry) {
    const size_t index = scenario_key_find(entry->section, entry->key);
    if (index < scenario_key_count()) {
        return index;
    }
    if (entry->section[0] == '\0') {
        scenario_complain(place, NULL, "%.*s stands outside a section", SCENARIO_SHOWN_MAX,
                          entry->key);
    } else {
        scenario_complain(place, entry, "unknown key");
    }
    return index;
}

/* The taker of the file's entries: each key once, and none beside the key it replaces. */
static bool take_entry(void *context, const scenario_place_t *place,
                       const scenario_entry_t *entry) {
    draft_t *const draft = context;
    const size_t index = find_key(place, entry);
    if (index == scenario_key_count()) {
        return false;
    }
    for (size_t other = 0; other < scenario_key_count(); other++) {
        const scenario_key_t *const stated = scenario_key_at(other);
        if (draft->author[other] == BY_FILE && stated->offset == scenario_key_at(index)->offset) {
            scenario_complain(place, entry,
                              "%s stands in this file already; at most one of them may",
                              stated->name);
            return false;
        }
    }
    return store(draft, index, entry->value, BY_FILE, place);
}

static bool setting_is_split(const char *text, char section[SETTING_NAME_SIZE],
                             char key[SETTING_NAME_SIZE]) {
    const size_t equals = strcspn(text, "=");
    const size_t dot = strcspn(text, ".=");
    if (text[equals] == '\0' || text[dot] != '.' || dot >= SETTING_NAME_SIZE ||
        equals - dot > SETTING_NAME_SIZE) {
        return false;
    }
    memcpy(section, text, dot);
    section[dot] = '\0';
    memcpy(key, text + dot + 1, equals - dot - 1);
    key[equals - dot - 1] = '\0';
    return true;
}

static bool is_text(const char *text, const scenario_place_t *place) {
    const bool is_sound = scenario_text_fault(text, strlen(text)) == strlen(text);
    if (!is_sound) {
        scenario_complain(place, NULL, "must be UTF-8 without control characters");
    }
    return is_sound;
}

static bool take_fault(draft_t *draft, const char *text, const scenario_place_t *place) {
    const scenario_key_t *const key = scenario_key_at(scenario_key_find("run", "faults"));
    return is_text(text, place) && scenario_value_add(key, text, place, &draft->scenario);
}

static bool take_setting(draft_t *draft, const char *text, const scenario_place_t *place) {
    char section[SETTING_NAME_SIZE];
    char key[SETTING_NAME_SIZE];
    if (!is_text(text, place)) {
        return false;
    }
    if (!setting_is_split(text, section, key)) {
        scenario_complain(place, NULL, "must be section.key=value, not \"%.*s\"",
                          SCENARIO_SHOWN_MAX, text);
        return false;
    }
    const scenario_entry_t entry = {section, key, strchr(text, '=') + 1};
    const size_t index = find_key(place, &entry);
    return index < scenario_key_count() && store(draft, index, entry.value, BY_SETTING, place);
}

static author_t author_of(const draft_t *draft, const char *section, const char *name) {
    return draft->author[scenario_key_find(section, name)];
}

static void lay_line_under_plant(draft_t *draft) {
    for (size_t index = 0; index < scenario_key_count(); index++) {
        const scenario_key_t *const key = scenario_key_at(index);
        const size_t model = scenario_key_find("line", key->name);
        if (strcmp(key->section, "plant") == 0 && model < scenario_key_count() &&
            draft->author[index] == BY_NOBODY) {
            scenario_value_copy(scenario_key_at(model), key, &draft->scenario);
        }
    }
}

/* What follows from several keys together. */
static void derive(draft_t *draft) {
    scenario_t *const scenario = &draft->scenario;
    lay_line_under_plant(draft);
    scenario->law.slope_is_absolute = author_of(draft, "law", "setpoint_slope") != BY_NOBODY;
    scenario->run.manual_flux_is_stated = author_of(draft, "run", "manual_flux") != BY_NOBODY;
    if (author_of(draft, "plant", "node_count") == BY_NOBODY) {
        scenario->plant.node_count = PLANT_DEFAULTS[scenario->plant.scheme].node_count;
    }
    if (author_of(draft, "plant", "substeps") == BY_NOBODY) {
        scenario->plant.substeps = PLANT_DEFAULTS[scenario->plant.scheme].substeps;
    }
    if (author_of(draft, "controller", "level_sample_time") == BY_NOBODY) {
        scenario->controller.level_sample_time = scenario->plant.level_sample_time;
    }
    if (author_of(draft, "run", "snapshot_period") == BY_NOBODY &&
        fault_last_cut(scenario->run.faults, scenario->run.fault_count) >= 0.0) {
        scenario->run.snapshot_period = scenario->controller.period;
    }
}

static bool draft_begin(draft_t *draft, FILE *messages) {
    const scenario_place_t place = {"default", 0, messages};
    memset(draft, 0, sizeof *draft);
    draft->scenario.controller.inlet_flux_max = SCENARIO_NO_LIMIT;
    draft->scenario.plant.inlet_flux_max = SCENARIO_NO_LIMIT;
    bool is_stored = true;
    for (size_t index = 0; index < scenario_key_count(); index++) {
        const char *const fallback = scenario_key_at(index)->fallback;
        is_stored =
            is_stored && (fallback == NULL || store(draft, index, fallback, BY_DEFAULT, &place));
    }
    return is_stored;
}

void scenario_defaults(scenario_t *scenario) {
    (void)scenario_read("", 0, "default", scenario, stderr);
}

static bool take_settings(draft_t *draft, const scenario_settings_t *settings, FILE *messages) {
    const scenario_place_t in_settings = {"--set", 0, messages};
    const scenario_place_t in_faults = {"--fault", 0, messages};
    bool is_taken = true;
    for (size_t index = 0; index < settings->count && is_taken; index++) {
        is_taken = take_setting(draft, settings->text[index], &in_settings);
    }
    for (size_t index = 0; index < settings->fault_count && is_taken; index++) {
        is_taken = take_fault(draft, settings->fault[index], &in_faults);
    }
    return is_taken;
}

bool scenario_read_with(const char *text, size_t length, const char *name,
                        const scenario_settings_t *settings, scenario_t *scenario, FILE *messages) {
    const scenario_place_t in_all = {name, 0, messages};
    draft_t draft;
    const scenario_taker_t taker = {&draft, take_entry};
    if (!draft_begin(&draft, messages) ||
        !scenario_ini_read(text, length, name, &taker, messages) ||
        !take_settings(&draft, settings, messages)) {
        return false;
    }
    derive(&draft);
    if (!scenario_rules_hold(&draft.scenario, draft.list_count, &in_all)) {
        return false;
    }
    draft.scenario.name = "scenario";
    *scenario = draft.scenario;
    return true;
}

bool scenario_read(const char *text, size_t length, const char *name, scenario_t *scenario,
                   FILE *messages) {
    const scenario_settings_t nothing = {0};
    return scenario_read_with(text, length, name, &nothing, scenario, messages);
}
