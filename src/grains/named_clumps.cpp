#include "src/grains/named_clumps.hpp"

namespace barchan {

namespace {

/// Two spheres of which one is 1.5 times as long as wide.
std::vector<ClumpSphere> dimer() { return {{{-0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}}; }

/// Four spheres that touch each other.
std::vector<ClumpSphere> tetrahedron() {
  const Real a = 1 / Kokkos::sqrt(Real(2));
  return {{{a, a, a}, 1}, {{a, -a, -a}, 1}, {{-a, a, -a}, 1}, {{-a, -a, a}, 1}};
}

/// Eight spheres that touch their neighbours along the edges of a cube.
std::vector<ClumpSphere> cube() {
  std::vector<ClumpSphere> spheres;
  for (int n = 0; n < 8; ++n)
    spheres.push_back({{n % 2 * 2. - 1, n / 2 % 2 * 2. - 1, n / 4 * 2. - 1}, 1});
  return spheres;
}

/// A grain like natural sand, of 14 spheres. It is synthetic: no grain was scanned for it. Two lie
/// along the middle; twelve are its corners. Recipe: an ellipsoid with axes L : I : S = 1 : 0.788 :
/// 0.621, so that I/L = S/I and S/sqrt(L I) = 0.7, the Corey shape factor usually taken for sand
/// (Dietrich, Water Resour. Res. 18, 1615 (1982)). Corners touch it from inside where its normals
/// are 12 points of a Fibonacci lattice on the sphere, each moved by up to 0.3 in each direction by
/// uniform_number(2, direction, corner); radius S/4. Spheres in the middle: radius 0.425 S, 0.55 (L
/// - S)/2 from the centre. The radius of corners, half that of the largest sphere inside, gives the
/// sphericity 0.85 that X-ray tomography finds on average for desert sand (Minerals 12, 581
/// (2022)). Sharper corners would leave waists.
std::vector<ClumpSphere> sand() {
  return {{{0.208, 0, 0}, 0.528},
          {{-0.208, 0, 0}, 0.528},
          {{0.217, 0.028, -0.292}, 0.311},
          {{-0.552, 0.211, -0.110}, 0.311},
          {{0.151, -0.419, -0.127}, 0.311},
          {{0.242, 0.418, -0.096}, 0.311},
          {{-0.663, -0.126, -0.008}, 0.311},
          {{0.609, -0.211, -0.031}, 0.311},
          {{-0.067, 0.475, 0.006}, 0.311},
          {{-0.421, -0.373, 0.024}, 0.311},
          {{0.674, 0.082, 0.027}, 0.311},
          {{-0.523, 0.196, 0.142}, 0.311},
          {{0.216, -0.333, 0.194}, 0.311},
          {{0.157, 0.072, 0.297}, 0.311}};
}

}  // namespace

std::vector<ClumpSphere> named_clump(std::string_view name) {
  if (name == "dimer") return dimer();
  if (name == "tetrahedron") return tetrahedron();
  if (name == "cube") return cube();
  if (name == "sand") return sand();
  return {};
}

}  // namespace barchan
