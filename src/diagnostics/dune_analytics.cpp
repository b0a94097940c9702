#include "src/diagnostics/dune_analytics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace barchan {
namespace {

/// Least-squares slope dx/dt of (t, x) samples [m/s]; not a number for fewer than two times.
template <class Samples>
double slope(const Samples& samples) {
  const auto n = static_cast<double>(samples.size());
  double mean_t = 0.0, mean_x = 0.0, covariance = 0.0, variance = 0.0;
  for (const auto& s : samples) {
    mean_t += s.t / n;
    mean_x += s.x / n;
  }
  for (const auto& s : samples) {
    covariance += (s.t - mean_t) * (s.x - mean_x);
    variance += (s.t - mean_t) * (s.t - mean_t);
  }
  return variance > 0.0 ? covariance / variance : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<DuneRecord> DuneTracker::update(double t, GrainCloud grains, std::int64_t n_fed) {
  const auto n_grains = static_cast<std::int64_t>(grains.size());
  std::vector<DuneRecord> records = find_dunes(grains, domain_, criteria_).records;
  if (n_initial_ < 0) n_initial_ = n_grains - n_fed;
  n_lost_ = n_initial_ + n_fed - n_grains;
  forget(t);

  const std::vector<int> track_of_record = match(records);
  for (Track& track : tracks_) track.missed = true;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (track_of_record[i] < 0) tracks_.push_back({.label = next_label_++});
    Track& track = track_of_record[i] < 0 ? tracks_.back() : tracks_[track_of_record[i]];
    extend(track, t, records[i]);
    records[i].t = t;
    records[i].dune = track.label;
    records[i].celerity = slope(track.samples);
    records[i].n_lost = n_lost_;
  }
  std::sort(records.begin(), records.end(),
            [](const DuneRecord& a, const DuneRecord& b) { return a.dune < b.dune; });
  return records;
}

std::vector<int> DuneTracker::labels(GrainCloud grains) const {
  const Dunes dunes = find_dunes(grains, domain_, criteria_);
  std::vector<int> label_of_record = match(dunes.records);
  int next_label = next_label_;
  for (int& track : label_of_record) track = track < 0 ? next_label++ : tracks_[track].label;
  std::vector<int> labels = dunes.of_grain;
  for (int& record : labels) record = record < 0 ? -1 : label_of_record[record];
  return labels;
}

/// Drops samples that a restart will measure again, and labels that have been missing for too long.
void DuneTracker::forget(double t) {
  for (Track& track : tracks_) {
    while (!track.samples.empty() && track.samples.back().t >= t) track.samples.pop_back();
  }
  std::erase_if(tracks_, [&](const Track& track) {
    return track.missed &&
           (track.samples.empty() || track.samples.back().t < t - criteria_.celerity_window);
  });
}

/// Index of the track of each record, -1 for a new dune: nearest pairs first.
std::vector<int> DuneTracker::match(const std::vector<DuneRecord>& records) const {
  struct Pair {
    double distance;
    int track, record;
  };
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    for (std::size_t i = 0; i < records.size(); ++i) {
      const Track& track = tracks_[k];
      const double d = std::hypot(domain_.nearest_x(records[i].cx - track.x),
                                  domain_.nearest_z(records[i].cz - track.z));
      if (d <= track.reach) pairs.push_back({d, static_cast<int>(k), static_cast<int>(i)});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  std::vector<int> track_of_record(records.size(), -1);
  std::vector<char> taken(tracks_.size(), 0);
  for (const Pair& pair : pairs) {
    if (taken[pair.track] || track_of_record[pair.record] >= 0) continue;
    taken[pair.track] = 1;
    track_of_record[pair.record] = pair.track;
  }
  return track_of_record;
}

void DuneTracker::extend(Track& track, double t, const DuneRecord& record) const {
  double x = record.cx;
  if (!track.samples.empty()) {
    const double last = track.samples.back().x;
    x = last + domain_.nearest_x(record.cx - last);
  }
  track.samples.push_back({t, x});
  // Keep the sample before the last even when it is older than the window. The tolerance keeps the
  // number of samples steady when the window is a multiple of the interval.
  const double oldest = t - criteria_.celerity_window * (1.0 + 1e-9);
  while (track.samples.size() > 2 && track.samples.front().t < oldest) track.samples.pop_front();
  track.missed = false;
  track.x = record.cx;
  track.z = record.cz;
  track.reach = std::max(record.w, record.l);
}

std::vector<double> DuneTracker::state() const {
  std::vector<double> numbers{static_cast<double>(n_initial_), static_cast<double>(n_lost_),
                              static_cast<double>(next_label_),
                              static_cast<double>(tracks_.size())};
  for (const Track& track : tracks_) {
    numbers.insert(numbers.end(),
                   {static_cast<double>(track.label), track.missed ? 1.0 : 0.0, track.x, track.z,
                    track.reach, static_cast<double>(track.samples.size())});
    for (const Sample& s : track.samples) numbers.insert(numbers.end(), {s.t, s.x});
  }
  return numbers;
}

void DuneTracker::set_state(std::span<const double> numbers) {
  std::size_t position = 0;
  const auto demand = [](bool possible) {
    if (!possible) throw std::runtime_error("the restart file's list of dunes is damaged");
  };
  const auto next = [&]() {
    demand(position < numbers.size());
    return numbers[position++];
  };
  const auto count = [&](auto largest, double least = 0) {
    const double number = next();
    demand(number >= least && number <= static_cast<double>(largest));
    return static_cast<decltype(largest)>(number);
  };
  constexpr auto most = std::int64_t{1} << 53;
  constexpr int last_label = std::numeric_limits<int>::max();
  DuneTracker fresh(domain_, criteria_);
  fresh.n_initial_ = count(most, -1);  // -1: no call yet, as in a flow without grains
  fresh.n_lost_ = count(most);
  fresh.next_label_ = count(last_label);
  for (auto n_tracks = count(most); n_tracks > 0; --n_tracks) {
    Track track{.label = count(last_label),
                .missed = next() != 0.0,
                .x = next(),
                .z = next(),
                .reach = next()};
    for (auto n = count(most); n > 0; --n) track.samples.push_back({.t = next(), .x = next()});
    demand(!track.samples.empty());
    fresh.tracks_.push_back(track);
  }
  demand(fresh.n_initial_ >= 0 || fresh.next_label_ == 0);  // no dunes before the first update
  demand(position == numbers.size());
  *this = fresh;
}

}  // namespace barchan
