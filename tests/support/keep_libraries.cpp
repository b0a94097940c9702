// Linked into every program of the debug preset: libraries stay loaded to the end. The plug-ins of
// Open MPI and PMIx leak, and are unloaded before the leak sanitizer looks; it could then no longer
// say whose leaks they are, and tests/hygiene/leaks.supp not tell them from ours.
extern "C" int dlclose(void*) { return 0; }
