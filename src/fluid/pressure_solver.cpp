#include "src/fluid/pressure_solver.hpp"

#include "src/fluid/conjugate_gradients.hpp"

namespace barchan {

std::unique_ptr<PressureSolver> make_pressure_solver(const PressureProblem& problem) {
  const bool relaxes = problem.config.preconditioner.is<RelaxedFft>();
  return std::make_unique<ConjugateGradients>(problem, relaxes);
}

}  // namespace barchan
