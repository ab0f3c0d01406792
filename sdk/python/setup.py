# SPDX-License-Identifier: MIT
"""What pyproject.toml cannot say: the package has the layout of the plugin contract, made from the checkout's headers as
packaging/CMakeLists.txt does."""

import subprocess
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

TREE = Path(__file__).resolve().parents[2]


class Build(build_py):
    def run(self) -> None:
        super().run()
        scripts, headers = TREE / "tests/abi", TREE / "sdk/include/dmrp"
        contract = [*sorted(headers.glob("*.h")), *sorted(headers.glob("ext/*.h"))]
        described = subprocess.run(["awk", "-f", scripts / "describe.awk", *contract], check=True, stdout=subprocess.PIPE)
        with (Path(self.build_lib) / "dmrp/abi.json").open("wb") as layout:
            made = ["awk", "-f", scripts / "json.awk", "-", scripts / "v1.txt"]
            subprocess.run(made, check=True, input=described.stdout, stdout=layout)


setup(cmdclass={"build_py": Build})
