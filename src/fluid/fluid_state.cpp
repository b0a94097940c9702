#include "src/fluid/fluid_state.hpp"

namespace barchan {

namespace {

FaceVector make_face_vector(const char* x, const char* y, const char* z, const Grid& grid) {
  return {Field(x, grid), Field(y, grid), Field(z, grid)};
}

}  // namespace

FluidState make_fluid_state(const Grid& grid) {
  FluidState s;
  s.grid = grid;
  s.u = make_face_vector("fluid: u", "fluid: v", "fluid: w", grid);
  s.p = Field("fluid: p", grid);
  s.p_previous = Field("fluid: p previous", grid);
  s.alpha_f = Field("fluid: alpha_f", grid);
  s.alpha_f_previous = Field("fluid: alpha_f previous", grid);
  s.nu_t = Field("fluid: nu_t", grid);
  s.rate_previous = make_face_vector("fluid: rate x", "fluid: rate y", "fluid: rate z", grid);
  s.du_dt = make_face_vector("fluid: du/dt", "fluid: dv/dt", "fluid: dw/dt", grid);
  Kokkos::deep_copy(s.alpha_f.storage, Real(1));
  Kokkos::deep_copy(s.alpha_f_previous.storage, Real(1));
  return s;
}

}  // namespace barchan
