#include "study/orders.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus {
namespace {

constexpr double steepest = 20;  ///< an order beyond is none
constexpr double highest = 2;    ///< of all that is varied here: errors that fall faster do so by chance

double fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / count,
               mean_y = std::accumulate(y.begin(), y.end(), 0.0) / count;
  double across = 0, along = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    across += (x[i] - mean_x) * (y[i] - mean_y);
    along += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return across / along;
}

}  // namespace

Convergence::Convergence(std::vector<double> size, std::vector<double> error, std::optional<double> reference)
    : size_(std::move(size)), error_(std::move(error)) {
  for (double& each : size_) each = std::log(each);
  for (double& each : error_) each = std::log(each);
  if (!reference) return;
  const double at = std::log(*reference);
  const auto [least, most] = std::minmax_element(size_.begin(), size_.end());
  if (at < *least || at > *most) reference_ = at;
}

/// log |h^p − r^p|/|p|, which is smooth where p is 0.
double Convergence::scaled(std::size_t run, double order) const {
  const double apart = std::abs(size_[run] - *reference_);
  if (order == 0) return std::log(apart);
  const double larger = std::max(order * size_[run], order * *reference_);
  return larger + std::log(-std::expm1(-std::abs(order) * apart) / std::abs(order));
}

double Convergence::order_between(std::size_t p, std::size_t q) const {
  const double fallen = error_[p] - error_[q], slope = fallen / (size_[p] - size_[q]);
  if (!reference_) return slope;
  // Rises with the order, whichever end the reference is at.
  const double sign = size_[p] > size_[q] ? 1 : -1;
  const auto beyond = [&](double order) { return sign * (scaled(p, order) - scaled(q, order) - fallen) > 0; };
  double low = -steepest, high = steepest;
  if (beyond(low) || !beyond(high)) return slope;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (beyond(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

std::vector<double> Convergence::between_neighbours() const {
  std::vector<double> orders;
  for (std::size_t i = 0; i + 1 < size_.size(); ++i) {
    if (size_[i] != size_[i + 1]) orders.push_back(order_between(i, i + 1));
  }
  return orders;
}

double Convergence::misfit(double order) const {
  std::vector<double> off;
  for (std::size_t i = 0; i < size_.size(); ++i) off.push_back(error_[i] - scaled(i, order));
  const double mean = std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size());
  double squares = 0;
  for (const double each : off) squares += (each - mean) * (each - mean);
  return squares;
}

std::optional<double> Convergence::fit() const {
  const std::vector<double> orders = between_neighbours();
  if (orders.empty()) return std::nullopt;
  if (!reference_) return fitted_slope(size_, error_);
  const auto [least, most] = std::minmax_element(orders.begin(), orders.end());
  // The best lies among those between neighbours; golden section.
  const double share = (std::sqrt(5.0) - 1) / 2;
  double low = *least, high = *most;
  for (int cut = 0; cut < 60; ++cut) {
    const double a = high - share * (high - low), b = low + share * (high - low);
    if (misfit(a) < misfit(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return (low + high) / 2;
}

std::optional<double> Convergence::error_of_reference() const {
  const std::optional<double> of_all = fit();
  if (!reference_ || !of_all) return std::nullopt;
  std::size_t next = 0;
  for (std::size_t i = 1; i < size_.size(); ++i) {
    if (std::abs(size_[i] - *reference_) < std::abs(size_[next] - *reference_)) next = i;
  }
  // Where errors last fell slower than over all, they may go on so.
  const std::vector<double> orders = between_neighbours();
  const double last = next == 0 ? orders.front() : orders.back(),
               slower = std::abs(last) < std::abs(*of_all) ? last : *of_all,
               order = std::clamp(slower, -highest, highest);
  // Errors fall towards it: p is above 0 where it is the smallest, below where it is the largest.
  if (order * (size_[next] - *reference_) <= 0) return std::nullopt;
  return std::exp(error_[next] - scaled(next, order) + order * *reference_) / std::abs(order);
}

}  // namespace talus
