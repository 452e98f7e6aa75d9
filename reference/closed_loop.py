# SPDX-License-Identifier: MIT
"""The closed loop in continuous time: the plant by characteristics, the law at every step.

The inlet flux is computed anew at each step and linear between, so nothing is held: the limit of
a controller whose period goes to 0. Second order in the step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reference import equilibrium, predictor
from reference.characteristics import Plant
from reference.line import Law, Line
from reference.nominal_law import NominalLaw, nominal_law

COLUMNS = (
    "time",
    "buffer_level",
    "level_setpoint",
    "inlet_flux",
    "outlet_flux",
    "congestion",
    "transport_speed",
    "predicted_level",
    "arrival_time",
    "survival",
)


@dataclass(frozen=True)
class Run:
    """What is run: control is 'predictor', 'uncompensated' or 'open_loop'.

    duration and step [s]; set-point changes at ascending setpoint_times [s] to setpoint_levels
    [parts]; initial_level [parts] held for a whole window before 0; initial_density [parts/m], a
    number or values equally spaced from outlet to inlet; inlet_flux_max [parts/s].
    The inlet flux is limited to [0, inlet_flux_max] whatever the law.
    """

    duration: float = 10.0
    step: float = 0.005
    control: str = "predictor"
    setpoint_times: tuple[float, ...] = ()
    setpoint_levels: tuple[float, ...] = ()
    initial_level: float = 0.0
    initial_density: float | tuple[float, ...] = 0.0
    inlet_flux_max: float = np.inf


def command(line: Line, law: NominalLaw, plant: Plant, run: Run):
    """(U before its limits [parts/s], p1(D), sigma(D), K(D, D)) at the plant's instant.

    The last three are NaN for a control that does not predict.
    """
    if run.control == "predictor":
        flux, result = predictor.inlet_flux(
            line, law, plant.positions, plant.densities, plant.history
        )
        if not 0.0 <= flux <= run.inlet_flux_max:
            positions = np.append(plant.positions, line.belt_length)
            fed = min(max(flux, 0.0), run.inlet_flux_max) / plant.transport_speed
            densities = np.append(plant.densities, fed)
            result = predictor.predict(line, positions, densities, plant.history)
        return flux, result.predicted_level[-1], result.arrival_time[-1], result.survival[-1]
    if run.control == "uncompensated":
        return law.flux(plant.level), np.nan, np.nan, np.nan
    if run.control == "open_loop":
        return equilibrium.inlet_flux(line, law.level_setpoint), np.nan, np.nan, np.nan
    raise ValueError(f"control {run.control!r} is none of predictor, uncompensated, open_loop")


def feed(line: Line, law: NominalLaw, plant: Plant, run: Run) -> tuple[float, ...]:
    """Feed what the law commands; returns the trace row (COLUMNS) of the instant."""
    flux, *predicted = command(line, law, plant, run)
    flux = min(max(flux, 0.0), run.inlet_flux_max)
    plant.feed(flux)
    measured = plant.outlet_flux, plant.congestion, plant.transport_speed
    return (plant.time, plant.level, law.level_setpoint, flux, *measured, *predicted)


def simulate(line: Line, law: Law, run: Run | None = None) -> dict[str, np.ndarray]:
    """The closed loop from time 0 on: one array per column of COLUMNS, one entry per step.

    At a set-point change the row holds what follows the change. The predicted columns are for
    the material fed at `time`.
    """
    run = run or Run()
    steps = round(run.duration / run.step)
    change_times = np.round(run.setpoint_times, 12)
    changes = dict(zip(change_times.tolist(), run.setpoint_levels, strict=True))
    instants = np.union1d(np.round(np.arange(steps + 1) * run.step, 12), change_times)
    active = nominal_law(line, law)
    spacing = run.step * float(line.transport_speed(run.initial_level * line.speed_window))
    plant = Plant(line, spacing, run.initial_level, run.initial_density)
    rows = [feed(line, active, plant, run)]
    for instant in instants[1:].tolist():
        plant.advance(instant)
        rows.append(feed(line, active, plant, run))
        if instant in changes:
            active = nominal_law(line, replace(law, level_setpoint=changes[instant]))
            rows[-1] = feed(line, active, plant, run)
    return dict(zip(COLUMNS, np.array(rows, dtype=float).T, strict=True))
