// Ten lines with our kernels: the Hertz force between two grains of 0.2 mm that overlap by 0.1 um.
#include <barchan/kernels/grains/contact_law.hpp>
#include <cmath>
#include <cstdio>

int main() {
  const barchan::Elastic glass{.youngs_modulus = 5e6, .poisson_ratio = 0.45};
  const double e = barchan::effective_youngs_modulus(glass, glass), r = 0.5e-4, overlap = 1e-7;
  const barchan::HertzMindlin law{.e_eff = e, .g_eff = 0, .damping = 0};
  const double force = law(r, 1e-8, overlap).elastic;
  std::printf("%.9e %.9e\n", force, 4. / 3 * e * std::sqrt(r) * std::pow(overlap, 1.5));
}
