/* SPDX-License-Identifier: MIT */
/*
 * plant.h - the conveyor and the buffer that are simulated, in double.
 *
 *     Q'    = alpha*phi + d - min(Q/service_time, mu), 0 <= Q <= level_capacity, the rest is spilled
 *     rho_t = omega(R)*rho_x + A*(D - x)*rho(0,t) - C(x)*rho,    omega(R)*rho(D,t) = flux fed
 *     phi   = omega(R)*rho(0,t),     omega(R) = 1/(P*(1 + R/congestion_scale))
 *
 * d is a disturbance: a flow into the buffer that comes from elsewhere; one that is negative takes
 * away what there is. d and mu may change from period to period. Service, rework and speed are those
 * of line.h: what stands above, unless the build has another line's laws.
 *
 * Two schemes. `characteristics` follows the material exactly and is the truth that the controller
 * is judged by; `upwind` is the paper's own first-order scheme. Neither shares a line or a
 * discretisation with the firmware.
 */
#ifndef HOST_SIM_PLANT_H
#define HOST_SIM_PLANT_H

#include <stdbool.h>
#include <stddef.h>

#include "line.h"
#include "speed_window.h"

typedef struct {
    const line_t *line;       /**< must outlive the plant. */
    double period;            /**< control period: what is fed is constant in it [s]. */
    size_t substeps;          /**< plant steps in a period, >= 1. */
    size_t node_count;        /**< upwind: cells; characteristics: least number of parcels. */
    double inlet_flux_max;    /**< what the valve lets through [parts/s], may be infinite. */
    double buffer_level;      /**< Q at the start and in the window before it [parts]. */
    const profile_t *density; /**< what lies on the belt at the start [parts/m]. */
} plant_setup_t;

/** Where the parts went, since the start [parts]. */
typedef struct {
    double fed;
    double served;
    double spilled;   /**< the buffer was full. */
    double diverted;  /**< left the belt but did not reach the buffer: the share 1 - alpha. */
    double lost;      /**< scrapped on the belt. */
    double reworked;  /**< put back on the belt. */
    double disturbed; /**< came into the buffer from elsewhere; negative: was taken away. */
} plant_account_t;

typedef struct plant plant_t;

/** What a scheme is. The belt behind the pointer is the scheme's own. */
typedef struct {
    bool (*create)(void **belt, const plant_t *plant);
    void (*destroy)(void *belt);
    /** One plant step at a constant flux; `fresh` on a period's first step. Moves level and belt. */
    void (*advance)(void *belt, plant_t *plant, double flux, bool fresh);
    /** Density about to leave, rho(0) [parts/m]. */
    double (*outlet_density)(const void *belt, const plant_t *plant);
    /** `count` >= 2 densities equally spaced from outlet to inlet [parts/m]. */
    void (*profile)(const void *belt, const plant_t *plant, double *density, size_t count);
    /** Parts on the belt. */
    double (*content)(const void *belt, const plant_t *plant);
} scheme_t;

/** The buffer and what sets the speed, the same for both schemes, and the belt of one of them. */
struct plant {
    plant_setup_t setup;
    const scheme_t *scheme;
    void *belt;              /**< the scheme's own. */
    double step;             /**< plant step [s]. */
    double level;            /**< Q [parts]. */
    double congestion;       /**< R [parts s]. */
    double applied_flux;     /**< what the valve let through in the last period [parts/s]. */
    double disturbance;      /**< d now [parts/s]. */
    double service_rate_max; /**< mu now [parts/s]. */
    double parts_at_start;   /**< on the belt and in the buffer [parts]. */
    speed_window_t window;
    plant_account_t account;
};

extern const scheme_t scheme_characteristics;
extern const scheme_t scheme_upwind;

/** A plant of one scheme, at its start. False when memory lacks; then there is nothing to destroy. */
bool plant_create(plant_t *plant, const plant_setup_t *setup, const scheme_t *scheme);
void plant_destroy(plant_t *plant);

/** Runs one control period with one command [parts/s]. */
void plant_advance(plant_t *plant, double command);

/** From here on the flow from elsewhere is `flow` [parts/s]. */
void plant_disturb(plant_t *plant, double flow);

/** From here on mu is `rate` >= 0 [parts/s]. */
void plant_change_service(plant_t *plant, double rate);

/** omega(R) now [m/s]. */
double plant_speed(const plant_t *plant);

/** phi now [parts/s]. */
double plant_outlet_flux(const plant_t *plant);

/** `count` >= 2 densities equally spaced from outlet to inlet [parts/m]. */
void plant_profile(const plant_t *plant, double *density, size_t count);

/** Parts in (fed, reworked, from elsewhere, there at the start) minus all that became of them
 * [parts]. */
double plant_balance_error(const plant_t *plant);

/** For the schemes: the buffer's share of one plant step. `left` parts left the belt; `middle` is the
 * level at which the service is taken. */
void plant_serve(plant_t *plant, double left, double middle);

/** What the buffer gives away at a level, with the plant's mu of now [parts/s]. */
double plant_service(const plant_t *plant, double level);

#endif
