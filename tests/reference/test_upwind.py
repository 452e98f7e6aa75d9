# SPDX-License-Identifier: MIT
"""Claims about the paper's own scheme, and what the misprint in (C0) does."""

import numpy as np
import pytest

from reference import equilibrium, first_order
from reference.characteristics import Plant
from reference.line import Law, Line
from reference.upwind import UpwindPlant, drive


def test_without_loss_and_rework_no_part_is_lost():
    line = Line(rework_rate=0.0, loss_rate=(0.0,), speed_window=0.23)
    plant = UpwindPlant(line, 40, 0.0025, 0.1, (0.1, 0.4))
    start = plant.densities[:-1].sum() * plant.dx + 0.0
    fed = left = 0.0
    for count in range(800):
        flux = 0.5 + 0.4 * np.sin(0.02 * count)
        left += plant.dt * plant.outlet_flux
        plant.substep(flux)
        fed += plant.dt * flux
    content = plant.densities[:-1].sum() * plant.dx
    assert start + fed == pytest.approx(content + left, rel=1e-12)  # exact but for rounding


def test_window_takes_a_fraction_of_the_oldest_interval():
    plant = UpwindPlant(Line(speed_window=0.25), 10, 0.1)
    plant.levels = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]  # Q = t: the mean over [0.25, 0.5] is 0.375
    assert plant.window_integral() == pytest.approx(0.25 * 0.375, rel=1e-13)


def test_first_substep_by_hand():
    plant = UpwindPlant(Line(), 2, 0.1, initial_level=0.2, initial_density=0.4)
    plant.substep(1.2)
    speed = 4.0 / 1.04
    assert plant.densities[2] == pytest.approx(1.2 / speed, rel=1e-14)
    middle = 0.4 + 0.1 * (speed * (1.2 / speed - 0.4) + 0.1 * 1.0 * 0.4 - 0.4)
    assert plant.densities[1] == pytest.approx(middle, rel=1e-14)
    assert plant.densities[0] == pytest.approx(0.4 + 0.1 * (0.1 * 2.0 * 0.4 - 0.4), rel=1e-14)
    assert plant.level == pytest.approx(0.2 + 0.1 * (0.5 * speed * 0.4 - 0.2), rel=1e-14)


def test_full_buffer_spills_and_counts():
    plant = UpwindPlant(Line(), 10, 0.01, initial_level=1.0, initial_density=1.0)
    plant.substep(4.0)
    assert plant.level == 1.0
    speed = 4.0 / 1.2
    assert plant.parts_spilled == pytest.approx(0.01 * (0.5 * speed - 0.8), rel=1e-12)


def test_upwind_approaches_the_characteristics_at_first_order():
    line = Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5))
    flux = equilibrium.inlet_flux(line, 0.3)
    exact = Plant(line, 0.01, 0.1, (0.1, 0.3, 0.2))
    exact.feed(flux)
    for count in range(1, 201):
        exact.advance(count * 0.005)
        exact.feed(flux)
    errors = []
    for node_count in (100, 200, 400):
        period = 0.2 / node_count
        periods = round(1.0 / period)
        trace = drive(line, np.full(periods, flux), period, 1, node_count, 0.1, (0.1, 0.3, 0.2))
        errors.append(abs(trace["buffer_level"][-1] - exact.level))
    assert errors[2] < 1e-3
    assert 1.6 < errors[0] / errors[1] < 2.4 and 1.6 < errors[1] / errors[2] < 2.4


def test_substeps_are_shorter_periods():
    flux = np.linspace(0.2, 1.0, 50)
    once = drive(Line(), np.repeat(flux, 4), 0.0025, 1)
    grouped = drive(Line(), flux, 0.01, 4)
    assert once["buffer_level"][::4] == pytest.approx(grouped["buffer_level"], rel=1e-14)


def test_the_misprint_in_c0_stalls_while_mf1_goes_to_the_setpoint():
    errors = {}
    for term in (first_order.rework_by_mf1, first_order.rework_as_printed_in_c0):
        for node_count, dt in ((40, 0.005), (80, 0.0025)):
            trace = first_order.simulate(Line(), Law(), 4.0, node_count, dt, term)
            errors[term, node_count] = trace["buffer_level"][-1] - 0.3
    right = [errors[first_order.rework_by_mf1, count] for count in (40, 80)]
    printed = [errors[first_order.rework_as_printed_in_c0, count] for count in (40, 80)]
    assert right[1] == pytest.approx(2.44e-4, rel=0.01)  # what the scheme gives, digits measured
    assert right[0] / right[1] == pytest.approx(2.0, rel=0.05)  # first order, towards 0
    assert printed[1] == pytest.approx(1.09e-3, rel=0.01)
    # extrapolated to a fine grid, the right law leaves nothing and the misprint 8.6e-4
    assert abs(2 * right[1] - right[0]) < 1e-5
    assert 2 * printed[1] - printed[0] == pytest.approx(8.6e-4, rel=0.05)


@pytest.mark.parametrize("level_setpoint", [0.1, 0.3, 0.5])
def test_equilibrium_flux_without_sources_is_the_hold_flux(level_setpoint):
    line = Line(rework_rate=0.0, loss_rate=(0.0,))
    flux = equilibrium.inlet_flux(line, level_setpoint)
    assert flux == pytest.approx(level_setpoint / 0.5, rel=1e-13)


def test_equilibrium_flux_with_uniform_loss_makes_up_for_it():
    line = Line(rework_rate=0.0)
    transit = 0.5 * (1.0 + 0.3 * 0.2)
    assert equilibrium.inlet_flux(line, 0.3) == pytest.approx(0.6 * np.exp(transit), rel=1e-13)


def test_open_loop_flux_of_the_paper():
    assert equilibrium.inlet_flux(Line(), 0.3) == pytest.approx(0.974, abs=5e-4)
