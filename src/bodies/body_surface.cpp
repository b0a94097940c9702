#include "src/bodies/body_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/atomic_file.hpp"
#include "src/bodies/body_extent.hpp"
#include "src/bodies/make_bodies.hpp"

namespace barchan {

namespace {

constexpr std::size_t kAround = 360, kOutwards = 31;  // every degree; heights of a sphere every 3
constexpr double kWithin = 1 - 1e-10;  // share of the way to the outline: places on it are inside
constexpr double kPerLength = 90, kMostAlong = 20000;

/// Finds by halving where the distance turns positive from `inside` towards `end`; else `end`.
template <class Distance>
double edge(double inside, double end, const Distance& distance) {
  for (int n = 0; n < 60; ++n) {
    const double middle = (inside + end) / 2;
    (distance(middle) < 0 ? inside : end) = middle;
  }
  return inside;
}

/// Way from the middle of a square of sides 2 to its outline; corners at odd multiples of pi/4.
std::array<double, 2> to_square(double angle) {
  const double c = std::cos(angle), s = std::sin(angle), along = std::sin(2 * angle);
  if (std::abs(c) >= std::abs(s)) return {std::copysign(1, c), std::copysign(1, c) * along};
  return {std::copysign(1, s) * along, std::copysign(1, s)};
}

/// Finds the outline of a body and its heights by its distance alone, whatever its shape.
class Surveyor {
 public:
  Surveyor(const BodyConfig& body, const std::array<double, 3>& domain)
      : body_(make_bodies({body}, domain).body[0]), domain_(domain), centre_(body.centre) {
    BodyConfig straight = body;
    straight.angle = 0;
    const Footprint foot = footprint(straight);
    const std::array<double, 2> half{foot.half_x, foot.half_z};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      endless_[axis] = half[axis] == 0;
      half_[axis] = half[axis] + (axis == 0 ? std::abs(foot.middle_x) : 0);
      if (endless_[axis]) half_[axis] = centre_[axis] = domain[2 * axis] / 2;
    }
    narrowest_ = foot.narrowest;
    top_ = body.base + foot.height;
    const double above = 1e-9 * foot.height;  // where a body that stands on the floor has an inside
    const double middle = std::max(body.base + foot.height / 2, above);
    widest_ = std::max(body.base, 0.0) + above;
    if (size_at(middle) >= size_at(widest_)) widest_ = middle;
  }

  BodySurface survey() {
    if (endless_[0] && endless_[1]) {
      across();
    } else {
      around();
    }
    return std::move(found_);
  }

 private:
  double distance(double x, double y, double z) const { return body_.distance({x, y, z}); }

  /// Place at a share of the way to the corner or side (p, q) of the box around the body.
  std::array<double, 2> place(double share, const std::array<double, 2>& towards) const {
    const double p = share * half_[0] * towards[0], q = share * half_[1] * towards[1];
    return {centre_[0] + body_.cosine * p - body_.sine * q,
            centre_[1] + body_.sine * p + body_.cosine * q};
  }

  /// Share of the way at which the outline at height y is.
  double outline(const std::array<double, 2>& towards, double y) const {
    return edge(0, 1, [&](double share) {
      const auto [x, z] = place(share, towards);
      return distance(x, y, z);
    });
  }
  double size_at(double y) const { return outline({1, 0}, y) + outline({0, 1}, y); }

  void add(double x, double z) {
    const auto up = [&](double y) { return distance(x, y, z); };
    found_.x.push_back(x);
    found_.z.push_back(z);
    found_.bottom.push_back(edge(widest_, 0, up));
    found_.top.push_back(edge(widest_, top_, up));
  }

  void around() {
    found_.lines = kAround, found_.points = kOutwards;
    for (std::size_t line = 0; line < kAround; ++line) {
      const auto towards = to_square(2 * std::numbers::pi * double(line) / kAround);
      const double end = kWithin * outline(towards, widest_);
      for (std::size_t n = 0; n < kOutwards; ++n) {
        const double angle = std::numbers::pi / 2 * double(n) / (kOutwards - 1);
        const auto [x, z] = place(end * std::sin(angle), towards);
        add(x, z);
      }
    }
  }

  void across() {
    const double lengths = std::max(1.0, std::round(domain_[0] / narrowest_));
    found_.lines = 1 + static_cast<std::size_t>(std::min(kPerLength * lengths, kMostAlong));
    found_.points = 2;
    for (std::size_t line = 0; line < found_.lines; ++line) {
      const double x = domain_[0] * double(line) / double(found_.lines - 1);
      add(x, 0);
      add(x, domain_[2]);
    }
  }

  Body body_;
  std::array<double, 3> domain_;
  std::array<double, 2> centre_, half_{};  // of the lattice, x and z
  std::array<bool, 2> endless_{};
  double narrowest_ = 0, top_ = 0, widest_ = 0;  // the two last above the floor
  BodySurface found_;
};

}  // namespace

BodySurface body_surface(BodyConfig body, const std::array<double, 3>& domain) {
  std::vector<double> copies{0, 0};
  if (body.shape.is<shapes::Fence>()) {
    copies.clear();
    const int posts = shapes::Fence::posts_of(body);
    for (int n = 0; n < posts; ++n) {
      const double q = body.spacing * (n - (posts - 1) / 2.0);
      copies.insert(copies.end(), {-std::sin(body.angle) * q, std::cos(body.angle) * q});
    }
    body.shape = BodyShape::of<shapes::Cylinder>();
    body.angle = 0;
  }
  BodySurface found = Surveyor(body, domain).survey();
  found.copies = std::move(copies);
  return found;
}

void write_body_surfaces(const std::filesystem::path& path, const std::vector<BodyConfig>& bodies,
                         const std::array<double, 3>& domain, const Provenance& provenance) {
  const std::filesystem::path beside = std::filesystem::path(path).concat(".tmp");
  Hdf5File file(beside, Hdf5File::Mode::create);
  write_provenance(file, provenance);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const BodySurface found = body_surface(bodies[n], domain);
    const std::string group = "body_" + std::to_string(n);
    const auto write = [&](const char* name, const std::vector<double>& values, Extents extents,
                           const char* words) {
      file.write<double>(group + "/" + name, values, extents, "m");
      file.set_attribute(group + "/" + name, "long_name", words);
    };
    const Extents lattice{found.lines, found.points};
    write("x", found.x, lattice, "places of the lattice along the stream");
    write("z", found.z, lattice, "places of the lattice across the stream");
    write("bottom", found.bottom, lattice, "height above the floor where the body begins");
    write("top", found.top, lattice, "height above the floor where the body ends");
    write("copies", found.copies, {found.copies.size() / 2, 2},
          "by how much each part of the body is moved along x and z");
  }
  file.close();
  rename_durably(beside, path);
}

}  // namespace barchan
