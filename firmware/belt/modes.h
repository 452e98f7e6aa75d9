/* SPDX-License-Identifier: MIT */
/*
 * modes.h - who is in command, and every way it can change.
 *
 * The operator asks for off, manual or automatic. What the controller then does also hangs on the
 * level: as long as it is trusted, automatic is automatic; once it is doubted the law goes on with
 * what stands in for the level (hold); once it is lost the substitute flux is fed (substitute). When
 * good samples come again it returns by itself. Off and manual work whatever the level does.
 */
#ifndef BELT_MODES_H
#define BELT_MODES_H

/** Who is in command. */
typedef enum {
    BELT_MODE_OFF,       /**< nothing is fed. */
    BELT_MODE_MANUAL,    /**< the operator's flux. */
    BELT_MODE_AUTOMATIC, /**< the law, on a level that is trusted. */
    BELT_MODE_HOLD,      /**< the law, on what stands in for a level that is doubted. */
    BELT_MODE_SUBSTITUTE /**< substitute_flux: the level is lost. */
} belt_mode_t;
#define BELT_MODE_COUNT 5

/** What moves the modes, in one period: what is asked for and, in automatic, how the level stands. */
typedef enum {
    BELT_EVENT_OFF,     /**< off is asked for. */
    BELT_EVENT_MANUAL,  /**< manual is asked for. */
    BELT_EVENT_TRUSTED, /**< automatic is asked for, the level is trusted. */
    BELT_EVENT_DOUBTED, /**< the same, but it is doubted. */
    BELT_EVENT_LOST     /**< the same, but it is lost. */
} belt_event_t;
#define BELT_EVENT_COUNT 5

/** How the command goes over. */
typedef enum {
    BELT_TRANSFER_NONE,    /**< the mode stays. */
    BELT_TRANSFER_AT_ONCE, /**< off closes, and what follows off starts from 0 at once. */
    BELT_TRANSFER_BUMPLESS /**< from the last command, with transfer_time, to the new mode's own. */
} belt_transfer_kind_t;

/* Every transition: row(from, event, to, transfer). Code, tests and documentation read this table and
 * nothing else. In any mode, the rate limit of the command holds on top. */
/* clang-format off */
#define BELT_TRANSITIONS(row)                      \
    row(OFF,        OFF,     OFF,        NONE)     \
    row(OFF,        MANUAL,  MANUAL,     AT_ONCE)  \
    row(OFF,        TRUSTED, AUTOMATIC,  AT_ONCE)  \
    row(OFF,        DOUBTED, HOLD,       AT_ONCE)  \
    row(OFF,        LOST,    SUBSTITUTE, AT_ONCE)  \
    row(MANUAL,     OFF,     OFF,        AT_ONCE)  \
    row(MANUAL,     MANUAL,  MANUAL,     NONE)     \
    row(MANUAL,     TRUSTED, AUTOMATIC,  BUMPLESS) \
    row(MANUAL,     DOUBTED, HOLD,       BUMPLESS) \
    row(MANUAL,     LOST,    SUBSTITUTE, BUMPLESS) \
    row(AUTOMATIC,  OFF,     OFF,        AT_ONCE)  \
    row(AUTOMATIC,  MANUAL,  MANUAL,     BUMPLESS) \
    row(AUTOMATIC,  TRUSTED, AUTOMATIC,  NONE)     \
    row(AUTOMATIC,  DOUBTED, HOLD,       BUMPLESS) \
    row(AUTOMATIC,  LOST,    SUBSTITUTE, BUMPLESS) \
    row(HOLD,       OFF,     OFF,        AT_ONCE)  \
    row(HOLD,       MANUAL,  MANUAL,     BUMPLESS) \
    row(HOLD,       TRUSTED, AUTOMATIC,  BUMPLESS) \
    row(HOLD,       DOUBTED, HOLD,       NONE)     \
    row(HOLD,       LOST,    SUBSTITUTE, BUMPLESS) \
    row(SUBSTITUTE, OFF,     OFF,        AT_ONCE)  \
    row(SUBSTITUTE, MANUAL,  MANUAL,     BUMPLESS) \
    row(SUBSTITUTE, TRUSTED, AUTOMATIC,  BUMPLESS) \
    row(SUBSTITUTE, DOUBTED, HOLD,       BUMPLESS) \
    row(SUBSTITUTE, LOST,    SUBSTITUTE, NONE)
/* clang-format on */

#endif
