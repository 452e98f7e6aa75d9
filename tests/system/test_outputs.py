# SPDX-License-Identifier: MIT
"""Result files are there whole or not at all, whatever happens to the run."""

import os
import resource
import signal
import stat
import subprocess

import pytest

from tests.system.command import SHORT, assert_refused, belt_sim, names_in

OUTPUTS = ["--trace", "--density", "--summary"]


def all_outputs(folder):
    return [word for option in OUTPUTS for word in (option, folder / f"{option[2:]}.out")]


@pytest.fixture
def old(tmp_path):
    """A folder whose outputs exist already, and hold `old`."""
    for option in OUTPUTS:
        (tmp_path / f"{option[2:]}.out").write_text("old")
    return tmp_path


def assert_untouched(folder):
    assert names_in(folder) == ["density.out", "summary.out", "trace.out"]
    for path in folder.iterdir():
        assert path.read_text() == "old"


@pytest.mark.parametrize(
    "setting",
    [
        "line.belt_length=2 m",  # the reader refuses
        "law.level_setpoint=0",  # the controller does
    ],
)
def test_refused_run_touches_no_output(setting, old):
    result = belt_sim("run", "paper", "--set", setting, *all_outputs(old))
    assert result.returncode == 2
    assert result.stderr != ""
    assert_untouched(old)


@pytest.mark.parametrize("option", OUTPUTS)
def test_output_that_cannot_be_opened_is_refused_before_the_run(option, old):
    others = [word for word in all_outputs(old) if word != option]
    others.remove(old / f"{option[2:]}.out")
    for place, reason in [
        (old / "no" / "such.csv", "No such file or directory"),
        (old, "Is a directory"),
        ("/proc/no.csv", "cannot write"),
        (old / ("n" * 300), "File name too long"),
    ]:
        result = belt_sim("run", "paper", *SHORT, *others, option, place)
        assert_refused(result, str(place), reason)
        assert_untouched(old)


def test_two_outputs_in_one_file_are_refused_however_they_are_written(old):
    for path in ("x.csv", "./x.csv", old / "x.csv", f"../{old.name}/x.csv"):
        result = belt_sim("run", "paper", *SHORT, "--trace", "x.csv", "--density", path, cwd=old)
        assert_refused(result, "two outputs lead to this file")
    (old / "link").symlink_to("trace.out")
    result = belt_sim("run", "paper", "--trace", "trace.out", "--summary", "link", cwd=old)
    assert_refused(result, "two outputs lead to this file")
    (old / "link").unlink()
    assert_untouched(old)


def test_output_over_the_scenario_itself_is_refused(tmp_path):
    scenario = tmp_path / "own.ini"
    scenario.write_text("[run]\nduration = 0.1\n")
    result = belt_sim("run", scenario, "--trace", "own.ini", cwd=tmp_path)
    assert_refused(result, "is the scenario itself")
    assert scenario.read_text() == "[run]\nduration = 0.1\n"


def test_output_replaces_what_a_link_leads_to_and_keeps_its_permissions(tmp_path):
    target = tmp_path / "target.csv"
    target.write_text("old")
    target.chmod(0o640)
    (tmp_path / "link.csv").symlink_to("target.csv")
    assert belt_sim("run", "paper", *SHORT, "--trace", tmp_path / "link.csv").returncode == 0
    assert (tmp_path / "link.csv").is_symlink()
    assert target.read_text().startswith("time,")
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


def test_new_output_has_the_permissions_the_user_gives_new_files(tmp_path):
    path = tmp_path / "trace.csv"
    result = belt_sim("run", "paper", *SHORT, "--trace", path, umask=0o027)
    assert result.returncode == 0
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


@pytest.mark.parametrize("option", OUTPUTS)
def test_full_device_fails_the_run_and_leaves_nothing(option, old):
    others = [word for word in all_outputs(old) if word != option]
    others.remove(old / f"{option[2:]}.out")
    result = belt_sim("run", "paper", *others, option, "/dev/full")
    assert result.returncode == 1
    assert result.stderr == "/dev/full: not written: No space left on device\n"
    assert_untouched(old)


def limit_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))


def test_file_that_cannot_grow_fails_the_run_and_leaves_nothing(old):
    # 41 rows fit, 4001 do not: both when the buffer is full and only at the end
    for duration in (0.2, 10):
        setting = f"run.duration={duration}"
        result = belt_sim(
            "run", "paper", "--set", setting, *all_outputs(old), preexec_fn=limit_files
        )
        assert result.returncode == 1
        assert "not written: File too large" in result.stderr
        assert_untouched(old)


@pytest.mark.parametrize("arguments", [["run", "paper", *SHORT], ["check", "paper"], ["list"]])
def test_lost_standard_output_fails_the_command(arguments):
    with open("/dev/full", "w") as full:
        result = belt_sim(*arguments, capture_output=False, stdout=full, stderr=subprocess.PIPE)
    assert result.returncode == 1
    assert "No space left on device" in result.stderr


def test_reader_of_standard_output_that_went_away_fails_the_run(old):
    reader, writer = os.pipe()
    os.close(reader)
    files = all_outputs(old)[:4]  # trace and density; the summary goes to the pipe
    result = belt_sim(
        "run", "paper", *SHORT, *files, capture_output=False, stdout=writer, stderr=subprocess.PIPE
    )
    os.close(writer)
    assert result.returncode == 1
    assert "Broken pipe" in result.stderr
    assert_untouched(old)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_interrupted_run_ends_by_its_signal_and_leaves_nothing(number, old):
    # The trace goes to a pipe: its first line tells that the run is under way, without a clock.
    command = [os.environ["BELT_SIM"], "run", "paper", "--set", "run.duration=1000"]
    options = [*map(str, all_outputs(old)[2:]), "--trace", "/dev/stdout"]
    with subprocess.Popen([*command, *options], stdout=subprocess.PIPE) as process:
        assert process.stdout.readline().startswith(b"time,")
        assert len(names_in(old)) == 5  # density and summary have their temporaries
        process.send_signal(number)
        process.stdout.read()
        assert process.wait() == -number
    assert_untouched(old)


def test_ignored_interrupt_stays_ignored(tmp_path):
    trace = tmp_path / "trace.csv"
    command = ["sh", "-c", 'trap "" INT; kill -INT $$; exec "$0" "$@"', os.environ["BELT_SIM"]]
    arguments = ["run", "paper", *SHORT, "--trace", str(trace)]
    assert subprocess.run([*command, *arguments], stdout=subprocess.DEVNULL).returncode == 0
    assert trace.exists()
