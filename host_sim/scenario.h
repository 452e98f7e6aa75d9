/* SPDX-License-Identifier: MIT */
/*
 * scenario.h - one run of the simulator, read from an INI file.
 *
 * The format is the part of INI that inih and Python's configparser (interpolation=None) read
 * alike. A line is one of: blank; a comment, `#` or `;` in its first column; `[section]`;
 * `key = value`. Text is UTF-8 without byte order mark and without control characters but tab,
 * with LF or CR LF line ends, at most 197 bytes a line and 65536 bytes in all. Refused besides:
 * indented lines (configparser continues the value above), `:` for `=`, comments behind a value,
 * a section or key stated twice, unknown names, [DEFAULT]. Numbers are decimal: 2, -0.5, 1e-3.
 *
 * A default yields to the file, the file to a setting, an earlier setting to a later one. A key
 * of [line] that [plant] does not state is the same in both. The keys, their defaults and ranges
 * stand in the table of scenario_keys.c.
 */
#ifndef HOST_SIM_SCENARIO_H
#define HOST_SIM_SCENARIO_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "fault.h"
#include "line.h"
#include "schedule.h"

/** Most bytes a scenario file holds. */
#define SCENARIO_SIZE_MAX 65536u

/** Most control periods in one run; keeps a slip of the pen from filling the disk. */
#define SCENARIO_STEPS_MAX 100000000.0

/** No limit: what an inlet_flux_max holds when the scenario leaves it out. */
#define SCENARIO_NO_LIMIT ((double)INFINITY)

typedef enum { LAW_PREDICTOR, LAW_FROZEN, LAW_UNCOMPENSATED, LAW_OPEN_LOOP } scenario_law_t;
typedef enum { DENSITY_OBSERVED, DENSITY_MEASURED } scenario_density_t;
typedef enum { OUTLET_MODELLED, OUTLET_MEASURED } scenario_outlet_t;
typedef enum { ESTIMATOR_OFF, ESTIMATOR_ON } scenario_estimator_t;
typedef enum { MODE_OFF, MODE_MANUAL, MODE_AUTOMATIC } scenario_mode_t;
typedef enum { SCHEME_CHARACTERISTICS, SCHEME_UPWIND } scenario_scheme_t;

typedef struct {
    const char *name; /**< what the controller's messages call it: "scenario", until the caller
                         gives it another. */
    line_t line;      /**< [line]: the model the controller is told. */
    struct {
        double level_setpoint;   /**< Q* at the start [parts]. */
        double nominal_flux_max; /**< Bmax [parts/s]. */
        bool slope_is_absolute;  /**< true: `slope` is setpoint_slope; false: it is slope_margin. */
        double slope;            /**< S or S - Smin [1/s]. */
    } law;
    struct {
        scenario_law_t law;
        scenario_density_t density;
        scenario_outlet_t outlet_flux;
        long node_count;
        double period;         /**< control period [s]. */
        double inlet_flux_max; /**< SCENARIO_NO_LIMIT when left out [parts/s]. */
        scenario_estimator_t estimator;
        double substitute_flux;   /**< fed while no level is to be had [parts/s]. */
        double level_sample_time; /**< time between two samples that the controller is told [s]. */
        /* The rest holds 0 when it is left out: the controller's own rule then gives it. */
        double estimator_time; /**< [s]. */
        double flux_rate_max;  /**< [parts/s^2]. */
        double level_step_max; /**< [parts]. */
        double transfer_time;  /**< [s]. */
        double hold_time;      /**< [s]. */
        long recovery_samples;
    } controller;
    struct {
        line_t line; /**< [line] with the keys of [plant] laid over it. */
        scenario_scheme_t scheme;
        long
            node_count; /**< upwind: cells; characteristics: least number of parcels on the belt. */
        long substeps;  /**< plant steps in one control period. */
        double inlet_flux_max;
        double level_noise;   /**< standard deviation of the noise on the level [parts]. */
        double level_quantum; /**< the measured level is a multiple of it [parts]; 0: of nothing. */
        double level_sample_time; /**< time between two samples [s]; 0: one each period. */
        long seed;                /**< of all that is random. */
        schedule_t disturbance;   /**< a flow into the buffer from elsewhere [parts/s]. */
        schedule_t service;       /**< greatest rates of service from a time on [parts/s]. */
    } plant;
    struct {
        double buffer_level;
        profile_t density;          /**< what lies on the plant's belt at the start [parts/m]. */
        profile_t observer_density; /**< what the controller believes lies there. */
    } initial;
    struct {
        double duration;      /**< [s]. */
        schedule_t setpoints; /**< Q* from a time on [parts]. */
        struct {
            double times[LIST_CAPACITY]; /**< [s]. */
            scenario_mode_t words[LIST_CAPACITY];
            size_t count;
        } modes;                    /**< what the operator asks for from a time on. */
        bool manual_flux_is_stated; /**< false: manual begins with the last command. */
        double manual_flux;         /**< what manual begins with [parts/s]. */
        schedule_t manual;          /**< how the operator moves it then [parts/s]. */
        double snapshot_period;     /**< time between two snapshots [s]; 0: none are taken. */
        fault_t faults[FAULT_CAPACITY];
        size_t fault_count;
    } run;
} scenario_t;

/** What the command line adds, in the order given. */
typedef struct {
    const char *const *text; /**< `section.key=value` each. */
    size_t count;
    const char *const *fault; /**< faults each, laid behind those of run.faults. */
    size_t fault_count;
} scenario_settings_t;

/** The paper's case: what an empty file gives. */
void scenario_defaults(scenario_t *scenario);

/** Reads a scenario from `length` bytes of text and lays the settings over it; `name` stands for
 * the text in messages. Opens nothing and keeps nothing between calls. Returns false after one line
 * on `messages` that names the first mistake: file and line (or `--set`, `--fault`), key, value and
 * limit; `scenario` is then untouched. */
bool scenario_read_with(const char *text, size_t length, const char *name,
                        const scenario_settings_t *settings, scenario_t *scenario, FILE *messages);

/** scenario_read_with() without settings. */
bool scenario_read(const char *text, size_t length, const char *name, scenario_t *scenario,
                   FILE *messages);

#endif
