# The help of the launcher, which reads it in. The man page is made from it; the completion of the shell reads it.
# shellcheck shell=bash
# shellcheck disable=SC2154  # command_name, installed and shared are the launcher's
usage() {
  cat << USAGE
Barchan: subaqueous dunes, every grain followed, the flow by large-eddy simulation

usage: $command_name COMMAND [arguments]

  run CASE.toml       run a case, then draw its pictures
      --set KEY=VALUE   change one key, e.g. grains.sliding_friction=0.4 (repeatable)
      --out DIR         run folder (default: runs/ and the path of the case below configs)
      --resume          continue from the last restart file, or begin if there is none
      --restart FILE    continue from a restart file, from the last one of a folder, or from "latest" of the run
      --overwrite       remove the results of an earlier run in the folder and begin again
      --threads N       threads per rank (default: all cores, shared by the ranks)
      --ranks N         MPI ranks on this machine (default: 1)
      --patience S      wall seconds without progress after which several ranks give up (default: 600, 0: never)
      --dry-run         check the case, print its derived numbers and warnings; nothing is run or written
      --starts-only     run the cases this one starts from where they are missing, then stop
      --quiet           show warnings and errors only
      --verbose         show derived numbers, rates and iterations, which log.txt always has
  check CASE.toml     validate a case; print what follows from its numbers, how long it takes, and warnings
      --set KEY=VALUE, --out DIR, --threads N   as of run
      --resolved        print also the case with every default as TOML, after the numbers
      --resolved-only   print the case with every default as TOML, nothing else
  new NAME            write a case of your own, with the flow and the heap it starts from
      --grains N, --diameter LENGTH, --density KG/M3, --velocity M/S   mesh, steps and box follow from these
      --from CASE       based on another case instead
  keys [NAME]         the keys of a case, of a section or of that name, with range, unit, default and meaning
      --schema          all keys as JSON Schema, by which an editor checks and completes a case
  sweep STUDY.toml    a parameter study: one run folder per case, continued where it was interrupted
      --out DIR         folder of the study (default: as of run)
      --only RUN ...    only these runs; patterns with * are allowed
      --at-once N       cases side by side (default: one for each core)
      --threads N       threads of each (default: all cores, shared by the cases)
      --overwrite       begin changed cases again
      --list            show the cases, run nothing
      --no-pictures     draw nothing
  plot RUN_DIR [FIGURE ...]   pictures of a run or a study; --help lists them
      --pdf, --svg      PDF files, SVG files besides the PNG files
      --time T, --from T, --to T   seconds, for figures of a moment and of means
      --only CASE       of a study: only this case; a pattern with * is allowed; may be repeated
      --debug           show where an unexpected error arose
  watch RUN_DIR | CASE.toml   keep report.html of a running case up to date; the page reloads itself
  vtk RUN_DIR         files for VTK and ParaView (VTKHDF) in RUN_DIR/vtkhdf, linked to the results
      --temporal        one file with all frames (VTK 9.3, ParaView 5.12 and newer) in place of one a frame
  list [FOLDER]       runs below a folder (default: runs): status, time reached, age, last restart file, size
  info PATH           what a run or study folder, a result, restart file, table or case holds
USAGE
  [ "$installed" = yes ] || cat << 'USAGE'
  plot validation     the figures of docs/validation.md, from saved results
  benchmark [NAME]    run, measure and score a case of benchmark/; --help lists the options
  test [CTEST ARGS]   build and run the tests (all but those labelled nightly)
  bench [NAME]        performance suite, or the cases with NAME in their name; adds records to runs/bench.jsonl
  docs                make a site of the documentation, with search, in build/site
  setup               install what is missing (Debian packages, Kokkos), nothing else; asks before it calls sudo
      --tests           also what test, bench and "build all" need, which these install themselves
      --docs            also what docs needs
  build [TARGET ...]  build only (default: the program; "all" for everything)

Everything but setup also builds when needed, and as root sets up.
USAGE
  cat << USAGE

Cases that are not in the current folder are looked for in $shared/configs. Start with:
  $command_name run configs/quickstart.toml

Exit codes: 0 done, 1 failed, 2 bad input, 3 stopped on request.

Environment:
  GLIBC_TUNABLES      of the C library (default: large pages)
  OMP_NUM_THREADS     threads per rank where --threads is not given
  BARCHAN_CPU         a level of instruction sets in place of the best that the processor has, e.g. x86-64-v3
  BARCHAN_PYTHON      the Python that draws (default: /usr/bin/python3)
  BARCHAN_PICTURES    no: run draws no pictures
USAGE
  [ "$installed" = yes ] || cat << 'USAGE'
  BARCHAN_PRESET      release, generic, ci, relwithdebinfo, debug, thread, rehearsal, fuzz, coverage, cuda, hip, sycl
  BARCHAN_DEPS        where a private Kokkos goes
  Kokkos_ROOT         a Kokkos of your own
  CMAKE_BUILD_PARALLEL_LEVEL   compile jobs
USAGE
}

commands() { usage | sed -n 's/^  \([a-z]\+\) .*/\1/p' | awk '!seen[$0]++' | paste -sd ' ' | sed 's/ /, /g'; }
