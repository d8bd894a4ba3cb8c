#include "scene/function.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace talus {
namespace {

double place_factor(const Product& product, Vec2 at) {
  return product.scale * (product.x ? (*product.x)(at.x) : 1) * (product.y ? (*product.y)(at.y) : 1);
}

}  // namespace

Table::Table(std::vector<double> at, std::vector<double> value)
    : at_(std::move(at)), value_(std::move(value)), area_(at_.size()) {
  for (std::size_t i = 1; i < at_.size(); ++i)
    area_[i] = area_[i - 1] + (at_[i] - at_[i - 1]) * (value_[i - 1] / 2 + value_[i] / 2);
  area_at_zero_ = antiderivative(0);
}

std::size_t Table::piece(double where) const {
  return static_cast<std::size_t>(std::upper_bound(at_.begin(), at_.end(), where) - at_.begin()) - 1;
}

double Table::operator()(double where) const {
  if (!(where > at_.front())) return value_.front();
  if (where >= at_.back()) return value_.back();
  const std::size_t i = piece(where);
  const double share = (where - at_[i]) / (at_[i + 1] - at_[i]);
  return (1 - share) * value_[i] + share * value_[i + 1];
}

double Table::over(const StepSpan& span) const {
  auto point = std::upper_bound(at_.begin(), at_.end(), span.begin);
  if (point == at_.end() || *point >= span.end) return (*this)(span.middle);
  double from = span.begin, value = (*this)(from), area = 0;
  const auto add = [&](double to, double value_there) {
    area += (to - from) * (value / 2 + value_there / 2);
    from = to, value = value_there;
  };
  for (; point != at_.end() && *point < span.end; ++point)
    add(*point, value_[static_cast<std::size_t>(point - at_.begin())]);
  add(span.end, (*this)(span.end));
  return area / (span.end - span.begin);
}

double Table::antiderivative(double where) const {
  if (!(where > at_.front())) return value_.front() * (where - at_.front());
  if (where >= at_.back()) return area_.back() + value_.back() * (where - at_.back());
  const std::size_t i = piece(where);
  return area_[i] + (where - at_[i]) * (value_[i] / 2 + (*this)(where) / 2);
}

double Table::integral(double where) const {
  return antiderivative(where) - area_at_zero_;
}

Table Table::held_from(double where) const {
  if (at_.back() <= where) return *this;
  std::vector<double> at, value;
  for (std::size_t i = 0; i < at_.size() && at_[i] < where; ++i)
    at.push_back(at_[i]), value.push_back(value_[i]);
  at.push_back(where);
  value.push_back((*this)(where));
  return {std::move(at), std::move(value)};
}

double Table::last_change() const {
  std::size_t last = value_.size() - 1;
  while (last > 0 && value_[last - 1] == value_.back()) --last;
  return last == 0 ? -std::numeric_limits<double>::infinity() : at_[last];
}

bool Table::zero_within(double low, double high) const {
  if ((*this)(low) != 0 || (*this)(high) != 0) return false;
  for (auto point = std::upper_bound(at_.begin(), at_.end(), low); point != at_.end() && *point < high;
       ++point) {
    if (value_[static_cast<std::size_t>(point - at_.begin())] != 0) return false;
  }
  return true;
}

double Function::operator()(double time, Vec2 at) const {
  double sum = 0;
  for (const Product& product : terms)
    sum += place_factor(product, at) * (product.time ? (*product.time)(time) : 1);
  return sum;
}

double Function::over(const StepSpan& span, Vec2 at) const {
  double sum = 0;
  for (const Product& product : terms)
    sum += place_factor(product, at) * (product.time ? product.time->over(span) : 1);
  return sum;
}

double Function::integral(double time, Vec2 at) const {
  double sum = 0;
  for (const Product& product : terms)
    sum += place_factor(product, at) * (product.time ? product.time->integral(time) : time);
  return sum;
}

Function Function::frozen(double time) const {
  Function still = *this;
  for (Product& product : still.terms) {
    if (product.time) product.scale *= (*product.time)(time);
    product.time.reset();
  }
  return still;
}

Function Function::held_from(double time) const {
  Function held = *this;
  for (Product& product : held.terms) {
    if (product.time) product.time = product.time->held_from(time);
  }
  return held;
}

bool Function::zero_within(Vec2 low, Vec2 high) const {
  return std::ranges::all_of(terms, [&](const Product& term) {
    return (term.x && term.x->zero_within(low.x, high.x)) || (term.y && term.y->zero_within(low.y, high.y));
  });
}

bool Function::zero_during(double from, double to) const {
  return std::ranges::all_of(
      terms, [&](const Product& term) { return term.time && term.time->zero_within(from, to); });
}

double Function::last_change() const {
  double last = -std::numeric_limits<double>::infinity();
  for (const Product& product : terms) {
    if (product.time) last = std::max(last, product.time->last_change());
  }
  return last;
}

Function Function::integrated(double time) const {
  Function still = *this;
  for (Product& product : still.terms) {
    product.scale *= product.time ? product.time->integral(time) : time;
    product.time.reset();
  }
  return still;
}

Function operator+(Function p, const Function& q) {
  p.terms.insert(p.terms.end(), q.terms.begin(), q.terms.end());
  return p;
}

Function operator*(double factor, Function function) {
  for (Product& product : function.terms) product.scale *= factor;
  return function;
}

void Function::add_kinks(Vec2 from, Vec2 to, std::vector<double>& shares) const {
  const auto add = [&](const std::optional<Table>& table, double start, double end) {
    if (!table || start == end) return;
    for (const double point : table->points()) {
      const double share = (point - start) / (end - start);
      if (share > 0 && share < 1) shares.push_back(share);
    }
  };
  for (const Product& product : terms) {
    add(product.x, from.x, to.x);
    add(product.y, from.y, to.y);
  }
}

}  // namespace talus
