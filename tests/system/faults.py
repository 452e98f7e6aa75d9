# SPDX-License-Identifier: MIT
"""Runs under one fault of each kind, for the tests that judge them."""

import os

from tests.system.runs import run

# Those that the build names; the sanitizers' is the one that sees a fault leave its memory.
PROGRAMS = [name for name in ("BELT_SIM", "BELT_SIM_SANITIZE") if name in os.environ]

MEASURED = ["buffer_level", "outlet_flux", "applied_flux", "density"]
WORDS = ["off", "stuck", "garbage", "wrong=0.5", "wrong=1.3", "slow=0.3", "delayed=0.2"]
WORDS += ["intermittent=0.3"]
VALVE_WORDS = [word for word in WORDS if word != "garbage"]
PERIOD_WORDS = ["off", "stuck", "garbage", "wrong=0", "wrong=3", "intermittent=0.3"]
FAULTS = [f"{signal}:{word}" for signal in MEASURED for word in WORDS]
FAULTS += [f"valve:{word}" for word in VALVE_WORDS] + [f"period:{word}" for word in PERIOD_WORDS]

FLUX_MAX = 2.5  # parts/s
FLUX_RATE_MAX = 300.0  # parts/s^2: 0.75 parts/s in a period
# A fault of a second in the settled line, and 16 s to recover: 30 transits.
START, LENGTH, DURATION = 4.0, 1.0, 21.0

# of firmware/belt/measurement.h and modes.h
MISSING, STALE = 0x1, 0x80
LATE, LOST, REPEATED, MISMATCH = 0x200, 0x400, 0x800, 0x1000
OFF, MANUAL, AUTOMATIC, HOLD, SUBSTITUTE = range(5)


def settings_for(fault, estimator):
    """The paper's line, with what the fault's signal needs."""
    signal = fault.split(":")[0]
    settings = [
        f"controller.estimator={estimator}",
        f"controller.inlet_flux_max={FLUX_MAX}",
        f"controller.flux_rate_max={FLUX_RATE_MAX}",
        f"run.duration={DURATION}",
    ]
    if signal in ("outlet_flux", "density"):
        settings.append(f"controller.{signal}=measured")
    return settings


def scenario_for(fault):
    """A measured profile suits a line that is smooth on the scale of a node, as upwind's is."""
    return "paper_upwind" if fault.startswith("density") else "paper"


def faulty(fault, *settings, scenario="paper", program="BELT_SIM", times=(START, LENGTH)):
    """A run under one fault; `fault` is `signal:word[=value]`."""
    text = f"{fault}@{times[0]}+{times[1]}"
    return run(scenario, *settings, f"run.faults={text}", program=program)
