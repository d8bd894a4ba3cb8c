#pragma once

#include "verification/case.hpp"

#include <atomic>
#include <functional>

namespace talus::verification {

/// What a case gave.
struct CaseResult {
  const Case* of = nullptr;
  std::vector<Row> rows;
  std::string trouble;  ///< words of what ended it before its end
  bool done = false;    ///< false where the verification was interrupted before

  bool held() const;
  std::size_t missed() const;  ///< rows, and one where it was ended before its end
};

struct VerifyOrder {
  std::vector<const Case*> cases;
  int threads = 1;  ///< cases at a time; each runs on one thread, so that their number changes no figure
  const std::atomic<bool>* interrupted = nullptr;  ///< asked between cases
  std::function<void(const CaseResult&)> finished =
      {};  ///< in the order of `cases`, never two calls at a time
  std::function<void(std::size_t done)> progress = {};  ///< after each case, never two calls at a time
};

/// Measures all cases. In the order of `cases`.
std::vector<CaseResult> verify(const Bench& bench, const VerifyOrder& order);

}  // namespace talus::verification
