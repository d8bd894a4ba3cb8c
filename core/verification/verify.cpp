#include "verification/verify.hpp"

#include "parallel/tasks.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <numeric>

namespace talus::verification {
namespace {

CaseResult result_of(const Case& each, const Bench& bench) {
  CaseResult result;
  result.of = &each;
  Rows rows;
  try {
    each.measure(bench, rows);
  } catch (const std::exception& problem) {
    result.trouble = problem.what();
  }
  result.rows = std::move(rows.rows);
  result.done = true;
  return result;
}

class Verification {
 public:
  Verification(const Bench& bench, const VerifyOrder& order)
      : bench_(bench), order_(order), results_(order.cases.size()), next_of_(order.cases.size()) {
    std::iota(next_of_.begin(), next_of_.end(), std::size_t{0});
    std::stable_sort(next_of_.begin(), next_of_.end(), [&](std::size_t p, std::size_t q) {
      return order.cases[p]->seconds > order.cases[q]->seconds;
    });
    for (std::size_t i = 0; i < results_.size(); ++i) results_[i].of = order.cases[i];
  }

  std::vector<CaseResult> make() {
    do_tasks(next_of_.size(), order_.threads, [this](std::size_t i) { measure(next_of_[i]); });
    return std::move(results_);
  }

 private:
  bool interrupted() const { return order_.interrupted != nullptr && *order_.interrupted; }

  void measure(std::size_t number) {
    if (interrupted()) return;
    CaseResult result = result_of(*order_.cases[number], bench_);
    const std::lock_guard lock(mutex_);
    results_[number] = std::move(result);
    if (order_.progress) order_.progress(++done_);
    for (; told_ < results_.size() && results_[told_].done; ++told_) {
      if (order_.finished) order_.finished(results_[told_]);
    }
  }

  const Bench& bench_;
  const VerifyOrder& order_;
  std::vector<CaseResult> results_;
  std::vector<std::size_t> next_of_;  ///< cases from the longest on
  std::size_t told_ = 0, done_ = 0;
  std::mutex mutex_;
};

}  // namespace

std::size_t CaseResult::missed() const {
  const auto is_missed = [](const Row& row) { return row.held.has_value() && !*row.held; };
  const auto count = static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), is_missed));
  return count + (trouble.empty() ? 0 : 1);
}

bool CaseResult::held() const {
  return done && missed() == 0;
}

std::vector<CaseResult> verify(const Bench& bench, const VerifyOrder& order) {
  return Verification(bench, order).make();
}

}  // namespace talus::verification
