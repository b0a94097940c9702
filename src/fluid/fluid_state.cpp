#include "src/fluid/fluid_state.hpp"

namespace barchan {

FaceVector make_faces(const char* label, const Grid& grid) {
  return {Field(label, grid), Field(label, grid), Field(label, grid)};
}

FluidState make_fluid_state(const Grid& grid) {
  FluidState s;
  s.grid = grid;
  s.u = make_faces("fluid: u", grid);
  s.p = Field("fluid: p", grid);
  s.p_previous = Field("fluid: p previous", grid);
  s.alpha_f = Field("fluid: alpha_f", grid);
  s.alpha_f_previous = Field("fluid: alpha_f previous", grid);
  s.nu_t = Field("fluid: nu_t", grid);
  s.rate_previous = make_faces("fluid: rate", grid);
  s.du_dt = make_faces("fluid: du/dt", grid);
  Kokkos::deep_copy(s.alpha_f.storage, Real(1));
  Kokkos::deep_copy(s.alpha_f_previous.storage, Real(1));
  return s;
}

}  // namespace barchan
