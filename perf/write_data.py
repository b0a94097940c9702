#!/usr/bin/env python3
"""Grains of a restart file, with their velocities, as a data file of LIGGGHTS or LAMMPS (atom_style sphere): so that
other programs start from the same moving dune.

usage: write_data.py RESTART.h5 GRAINS.data
"""

import sys
import tomllib

import h5py


def main():
    restart, target = sys.argv[1:]
    with h5py.File(restart) as file:
        grains = file["grains"]
        rows = sorted(zip(grains["id"][:].tolist(), grains["kin"][:].tolist()))
        config = file.attrs["config"]
    case = tomllib.loads(config.decode() if isinstance(config, bytes) else config)
    density = case["grains"]["density"]
    with open(target, "w", encoding="utf-8") as out:
        out.write(f"grains of {restart}\n\n{len(rows)} atoms\n1 atom types\n\n")
        out.writelines(f"0 {length} {axis}lo {axis}hi\n" for length, axis in zip(case["domain"]["size"], "xyz"))
        out.write("\nAtoms\n\n")
        out.writelines(f"{i} 1 {2 * k[3]:.9g} {density:.9g} {k[0]:.12g} {k[1]:.12g} {k[2]:.12g}\n" for i, k in rows)
        out.write("\nVelocities\n\n")
        out.writelines(f"{i} " + " ".join(f"{v:.9g}" for v in k[4:7] + k[8:11]) + "\n" for i, k in rows)


if __name__ == "__main__":
    main()
