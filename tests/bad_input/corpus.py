"""All entries, by kind."""

import command_line
import contradictions
import disks
import grain_tables
import hdf5_files
import names
import ranks
import restarts
import scripts
import starts
import syntax
import unknown_keys
import wrong_values

KINDS = {
    "syntax": syntax,
    "keys": unknown_keys,
    "values": wrong_values,
    "contradictions": contradictions,
    "starts": starts,
    "grain tables": grain_tables,
    "HDF5 files": hdf5_files,
    "restarts": restarts,
    "command line": command_line,
    "ranks": ranks,
    "disks": disks,
    "names": names,
    "scripts": scripts,
}


def entries():
    found = [(kind, entry) for kind, module in KINDS.items() for entry in module.ENTRIES]
    names_seen = [entry.name for _, entry in found]
    twice = {name for name in names_seen if names_seen.count(name) > 1}
    if twice:
        raise ValueError(f"two entries are named {', '.join(sorted(twice))}")
    return found
