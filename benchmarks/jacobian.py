"""Jacobians side by side with what else there is: `python benchmarks/jacobian.py`.

It takes no arguments. The peers are installed into a virtual environment of their own, once, and
everything runs there, on one core. All Jacobians are compared to 1e-9 before any is timed. The
contenders take turns, and the tables quote medians over the rounds and, in brackets, the range of
the middle half of the ratios: trust the ratios.
"""

import argparse
import os
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PEERS = (
    "numba",
    "casadi",
    "jax",
    "pin",
    "mujoco",
    "drake",
    "PyKDL",
    "roboticstoolbox-python",
    "modern_robotics",
    "kinpy",
)
ONE_CORE = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--venv", type=Path, default=ROOT / "build" / "benchmark-venv", help="where the peers live"
    )
    parser.add_argument("--rounds", type=int, default=9)
    options = parser.parse_args()
    command = [
        prepared(options.venv),
        str(Path(__file__).with_name("tables.py")),
        str(options.rounds),
    ]
    sys.exit(subprocess.run(command, env=os.environ | ONE_CORE, check=False).returncode)


def prepared(folder: Path) -> str:
    """Python of the virtual environment with the engine and those peers that can be installed."""
    python, done = str(folder / "bin" / "python"), folder / "peers-installed"
    if not done.exists():
        print(f"installing {', '.join(PEERS)} into {folder}", file=sys.stderr)
        venv.create(folder, with_pip=True, clear=True)
        pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        subprocess.run([*pip, "numpy>=2"], check=True)
        for peer in PEERS:
            subprocess.run([*pip, peer, "numpy>=2"], check=False)
        subprocess.run([*pip, "--no-deps", "--editable", str(ROOT)], check=True)
        done.touch()
    return python


if __name__ == "__main__":
    main()
