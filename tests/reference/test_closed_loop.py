# SPDX-License-Identifier: MIT
"""Claims about the closed loop, measured against the shift theorem and against itself."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from reference import equilibrium
from reference.characteristics import Plant
from reference.closed_loop import Run, simulate
from reference.line import Law, Line
from reference.nominal_law import nominal_law
from reference.shift_theorem import level_of

HEAVY = Line(speed_window=3.0)


def error_of(line, trace, **options):
    exact = level_of(line, Law(), trace["time"], **options)
    return np.max(np.abs(trace["buffer_level"] - exact))


def test_level_obeys_the_shift_theorem(paper_run):
    assert error_of(Line(), paper_run) < 1e-5  # second order at 5 ms: 2.5e-6 measured


def test_level_obeys_the_shift_theorem_with_a_heavy_window(heavy_run):
    assert error_of(HEAVY, heavy_run) < 1e-5  # 2.2e-6 measured


def test_level_obeys_the_shift_theorem_from_a_loaded_line():
    line = Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5), rework_rate=0.3)
    start = {"initial_level": 0.2, "initial_density": (0.1, 0.3, 0.2)}
    trace = simulate(line, Law(), Run(duration=2.0, **start))
    assert np.all(trace["inlet_flux"] > 0.0)  # else the theorem does not hold
    assert error_of(line, trace, **start) < 2e-5  # second order, steeper than the paper's case


def test_refinement_divides_the_error_by_four():
    coarse = error_of(Line(), simulate(Line(), Law(), Run(duration=1.5, step=0.01)))
    fine = error_of(Line(), simulate(Line(), Law(), Run(duration=1.5, step=0.005)))
    assert 3.3 < coarse / fine < 4.7  # 4 for second order; the instants compared differ


def test_setpoint_step_takes_effect_at_its_arrival_and_only_there(paper_run):
    change = {"setpoint_times": (1.0,), "setpoint_levels": (0.45,)}
    trace = simulate(Line(), Law(), Run(duration=2.5, **change))
    at_change = np.flatnonzero(trace["time"] == 1.0)[0]
    arrival = trace["arrival_time"][at_change]
    before = trace["time"] < arrival
    same = trace["buffer_level"][before] - paper_run["buffer_level"][before]
    assert np.max(np.abs(same)) < 1e-12  # nothing of the step arrives earlier
    assert trace["level_setpoint"][at_change - 1 : at_change + 1].tolist() == [0.3, 0.45]
    assert error_of(Line(), trace, **change) < 1e-5


def test_a_step_down_that_asks_for_negative_flux_shows_the_clamp():
    change = {"setpoint_times": (1.5,), "setpoint_levels": (0.30,)}
    law = Law(level_setpoint=0.45)
    trace = simulate(Line(), law, Run(duration=3.0, **change))
    exact = level_of(Line(), law, trace["time"], **change)
    assert trace["inlet_flux"].min() == 0.0
    assert 5e-4 < np.max(np.abs(trace["buffer_level"] - exact)) < 3e-3  # 1.4e-3 measured
    assert trace["buffer_level"][-1] == pytest.approx(0.3, abs=1e-4)


@pytest.mark.parametrize("name", ["paper_run", "heavy_run"])
def test_prediction_equals_the_future(name, request):
    trace = request.getfixturevalue(name)
    moving = trace["time"] >= 0.5  # before, the level is 0 and has a kink at 0.5
    level = CubicSpline(trace["time"][moving], trace["buffer_level"][moving])
    speed = CubicSpline(trace["time"][moving], trace["transport_speed"][moving])
    density = trace["outlet_flux"] / trace["transport_speed"]
    leaving = CubicSpline(trace["time"][moving], density[moving])
    law = nominal_law(Line(), Law())
    known = trace["arrival_time"] < trace["time"][-1]
    predicted, arrival = trace["predicted_level"][known], trace["arrival_time"][known]
    # both are second order at 5 ms with the same p1; the sum of their errors
    assert np.max(np.abs(level(arrival) - predicted)) < 5e-6
    demanded = np.array([law.flux(value) for value in predicted]) / speed(arrival)
    # slope of u is 22, thirty times as sensitive
    assert np.max(np.abs(leaving(arrival) - demanded)) < 1e-4


def test_arrival_is_when_the_belt_has_moved_by_its_length(heavy_run):
    distance = CubicSpline(heavy_run["time"], heavy_run["transport_speed"]).antiderivative()
    known = heavy_run["arrival_time"] < heavy_run["time"][-1]
    travelled = distance(heavy_run["arrival_time"][known]) - distance(heavy_run["time"][known])
    assert travelled == pytest.approx(np.full(known.sum(), 2.0), abs=2e-5)  # second order


def test_survival_at_the_inlet_falls_monotonically(paper_run):
    survival = paper_run["survival"]
    assert survival[0] == pytest.approx(0.6065, abs=5e-5)
    assert survival[-1] == pytest.approx(0.5886, abs=5e-5)
    # the quadrature ripples by 2.5e-11 a step at rest, against 4e-4 on the way down
    assert np.all(np.diff(survival) <= 1e-10)


def test_mass_is_conserved_without_loss_and_rework():
    line = Line(rework_rate=0.0, loss_rate=(0.0,))
    plant = Plant(line, 0.02, 0.1, (0.1, 0.4))
    start = plant.belt_content
    fed = served = 0.0
    plant.feed(0.8)
    for count in range(1, 401):
        level = plant.level
        plant.advance(count * 0.005)
        plant.feed(0.8)
        fed += 0.8 * 0.005
        served += 0.0025 * (line.service(level) + line.service(plant.level))
    left = (plant.level - 0.1 + served) / line.connectivity
    # trapezoid rules of belt, flux and service: second order at 5 ms
    assert start + fed == pytest.approx(plant.belt_content + left, abs=2e-5)


def test_mass_balances_at_every_instant_with_loss_and_rework():
    line = Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5), rework_rate=0.3)
    plant = Plant(line, 0.02, 0.1, (0.1, 0.4))

    def sources():
        rework = line.rework(plant.positions, plant.densities[0])
        net = rework - line.loss(plant.positions) * plant.densities
        return np.trapezoid(net, plant.positions), plant.outlet_flux

    plant.feed(0.4 * plant.transport_speed)  # no jump: the flux that continues the belt
    content, gained, worst = plant.belt_content, 0.0, 0.0
    flux = 0.4 * plant.transport_speed
    before = sources()
    for count in range(1, 201):
        plant.advance(count * 0.005)
        plant.feed(flux)
        after = sources()
        gained += 0.0025 * (sum(before[:1]) + sum(after[:1]) - before[1] - after[1]) + 0.005 * flux
        before = after
        worst = max(worst, abs(plant.belt_content - content - gained))
    assert worst < 5e-5  # second order at 5 ms, kinks of the profile between the nodes


def test_the_stationary_belt_stays():
    line = Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5))
    places = np.linspace(0.0, 2.0, 201)
    density = [equilibrium.density(line, 0.3, place) for place in places]
    run = Run(duration=1.0, initial_level=0.3, initial_density=tuple(density))
    trace = simulate(line, Law(), run)
    flux = equilibrium.inlet_flux(line, 0.3)
    assert trace["buffer_level"] == pytest.approx(np.full(201, 0.3), abs=1e-5)  # second order
    assert trace["inlet_flux"] == pytest.approx(np.full(201, flux), abs=2e-4)  # 22 times that


def held(flux, duration):
    plant = Plant(Line(), 0.08)
    for count in range(1, round(duration / 0.02) + 1):
        plant.feed(flux)
        plant.advance(count * 0.02)
    return plant.level


def test_open_loop_is_the_flux_of_the_equilibrium():
    assert held(equilibrium.inlet_flux(Line(), 0.3), 20.0) == pytest.approx(0.3, abs=5e-5)
    assert held(0.6, 20.0) == pytest.approx(0.187, abs=5e-4)  # Q*/alpha forgets the losses


def test_uncompensated_law_swings_and_stays_below_the_setpoint():
    trace = simulate(Line(), Law(), Run(duration=10.0, step=0.02, control="uncompensated"))
    late = trace["buffer_level"][trace["time"] > 2.0]
    assert late.max() < 0.3 and late.max() - late.min() > 0.02
    assert late.mean() == pytest.approx(0.28, abs=0.01)


def test_an_actuator_limit_leaves_the_prediction_true():
    trace = simulate(Line(), Law(), Run(duration=2.0, inlet_flux_max=1.5))
    assert trace["inlet_flux"].max() == 1.5
    moving = trace["time"] >= 0.5
    level = CubicSpline(trace["time"][moving], trace["buffer_level"][moving])
    known = trace["arrival_time"] < 2.0
    error = level(trace["arrival_time"][known]) - trace["predicted_level"][known]
    assert np.max(np.abs(error)) < 2e-5  # second order, with a kink where the limit lets go


def test_the_run_does_not_depend_on_the_units():
    parts, seconds, metres = 100.0, 1 / 60, 3.28
    line = Line(
        belt_length=2.0 * metres,
        processing_time=0.25 * seconds / metres,
        speed_window=0.2 * seconds,
        congestion_scale=parts * seconds,
        service_rate_max=0.8 * parts / seconds,
        service_time=seconds,
        level_capacity=parts,
        rework_rate=0.1 / metres / seconds,
        loss_rate=(1.0 / seconds,),
    )
    law = Law(0.3 * parts, 1.2 * parts / seconds, slope_margin=20.0 / seconds)
    here = simulate(Line(), Law(), Run(duration=1.5, step=0.02))
    there = simulate(line, law, Run(duration=1.5 * seconds, step=0.02 * seconds))
    assert there["buffer_level"] / parts == pytest.approx(here["buffer_level"], abs=1e-9)
    flux = there["inlet_flux"] * seconds / parts
    assert flux == pytest.approx(here["inlet_flux"], abs=1e-8)


def test_delay_free_oracle_delays_a_step_by_the_constant_transit():
    line = Line(congestion_scale=1e15)
    change = {"setpoint_times": (1.0,), "setpoint_levels": (0.45,)}
    times = np.array([1.5, 1.5 + 1e-3])
    stepped = level_of(line, Law(), times, **change)
    calm = level_of(line, Law(), times)
    assert stepped[0] == pytest.approx(calm[0], abs=1e-10)
    # from rest near 0.3 the level takes off with alpha*(u(0.45, Q) - u(0.3, Q)), about 0.3/s
    law, old = nominal_law(line, Law(level_setpoint=0.45)), nominal_law(line, Law())
    rise = 0.5 * (law.flux(calm[0]) - old.flux(calm[0])) * 1e-3
    assert stepped[1] - calm[1] == pytest.approx(rise, rel=2e-2)
    later = level_of(line, Law(), times + 0.005, (0.9975,), (0.45,), period=0.0075)
    assert later[0] == pytest.approx(level_of(line, Law(), times + 0.005, (0.9975,), (0.45,))[0])
