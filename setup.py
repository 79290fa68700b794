"""Names the packages of the one import name, whose folders stand side by side in the checkout."""

from setuptools import find_packages, setup

FOLDERS = ("benchmarks", "certificates", "proofs", "symbolic")

setup(
    packages=[
        *(name for name in find_packages() if name.split(".")[0] == "juggleproof"),
        *(
            f"juggleproof.{name}"
            for folder in FOLDERS
            for name in [folder, *(f"{folder}.{inner}" for inner in find_packages(folder))]
        ),
    ],
    package_dir={f"juggleproof.{folder}": folder for folder in FOLDERS},
)
