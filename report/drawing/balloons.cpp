// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/balloons.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueflank/base/contract.h"

namespace trueflank::io {
namespace {

// what a crossing is worth in millimetres of line, and a line through another number
constexpr double kCrossing_mm = 150.0, kThrough_mm = 300.0;
constexpr int kRounds = 30;

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

bool segments_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 along = b - a;
  const double t = std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
  return (p - a - t * along).norm();
}

class Seating {
 public:
  Seating(const std::vector<Balloon>& balloons, const std::vector<Point2>& seats)
      : balloons_(balloons), seats_(seats), seat_of_(balloons.size()), place_of_(balloons.size(), 0) {
    // first the order of the heights on each side, which crosses little
    std::vector<std::size_t> order(balloons.size()), free(seats.size());
    std::iota(order.begin(), order.end(), 0);
    std::iota(free.begin(), free.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return feature(a).y() > feature(b).y(); });
    std::stable_sort(free.begin(), free.end(), [&](std::size_t a, std::size_t b) { return seats[a].y() > seats[b].y(); });
    for (std::size_t i = 0; i < order.size(); ++i) seat_of_[order[i]] = free[i * free.size() / order.size()];
  }

  /// Moves and exchanges one at a time while the sum falls.
  void improve() {
    double best = cost();
    for (int round = 0; round < kRounds; ++round) {
      const double before = best;
      for (std::size_t i = 0; i < balloons_.size(); ++i) {
        for (std::size_t seat = 0; seat < seats_.size(); ++seat) try_seat(i, seat, best);
        for (std::size_t place = 0; place < balloons_[i].places.size(); ++place) try_place(i, place, best);
      }
      if (best > before - 1e-9) return;
    }
  }

  [[nodiscard]] const Point2& seat(std::size_t i) const { return seats_[seat_of_[i]]; }
  [[nodiscard]] const Point2& feature(std::size_t i) const { return balloons_[i].places[place_of_[i]]; }

 private:
  void try_seat(std::size_t i, std::size_t wanted, double& best) {
    const std::size_t old = seat_of_[i];
    if (wanted == old) return;
    const auto other = std::find(seat_of_.begin(), seat_of_.end(), wanted);
    const bool taken = other != seat_of_.end();
    if (taken) *other = old;
    seat_of_[i] = wanted;
    if (const double now = cost(); now < best - 1e-9) {
      best = now;
      return;
    }
    seat_of_[i] = old;
    if (taken) *other = wanted;
  }

  void try_place(std::size_t i, std::size_t wanted, double& best) {
    const std::size_t old = place_of_[i];
    place_of_[i] = wanted;
    if (const double now = cost(); now < best - 1e-9)
      best = now;
    else
      place_of_[i] = old;
  }

  [[nodiscard]] double cost() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < balloons_.size(); ++i) {
      sum += (feature(i) - seat(i)).norm();
      for (std::size_t k = 0; k < balloons_.size(); ++k) {
        if (k == i) continue;
        if (distance_to_segment(seat(k), seat(i), feature(i)) < kBalloonRadius_mm + 0.5) sum += kThrough_mm;
        if (k > i && segments_cross(seat(i), feature(i), seat(k), feature(k))) sum += kCrossing_mm;
      }
    }
    return sum;
  }

  const std::vector<Balloon>& balloons_;
  const std::vector<Point2>& seats_;
  std::vector<std::size_t> seat_of_, place_of_;
};

}  // namespace

void draw_balloons(Sheet& sheet, const std::vector<Balloon>& balloons, const std::vector<Point2>& seats) {
  TRUEFLANK_EXPECTS(seats.size() >= balloons.size());
  Seating seating(balloons, seats);
  seating.improve();
  for (std::size_t i = 0; i < balloons.size(); ++i) {
    const Point2 centre = seating.seat(i), feature = seating.feature(i);
    const Point2 towards = (feature - centre).normalized();
    sheet.circle(centre, kBalloonRadius_mm, Pen::kThin);
    sheet.text(centre - Point2(0.0, 1.4), std::to_string(balloons[i].number), 3.0, TextAnchor::kMiddle);
    sheet.line(centre + kBalloonRadius_mm * towards, feature, Pen::kThin);
    sheet.dot(feature);
  }
}

}  // namespace trueflank::io
