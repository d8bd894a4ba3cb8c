// What this machine can do at most, as JSON: arithmetic of one thread, and memory traffic of one and of all
// threads.

#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <thread>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace {

constexpr int rounds = 30;  ///< the best one counts: it was disturbed least

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// One thread is measured by its own time, several by that of the world.
template <class Work>
double least_seconds(clockid_t clock, const Work& work) {
  double least = 1e9;
  for (int i = 0; i < rounds; ++i) {
    const double before = seconds_of(clock);
    work();
    least = std::min(least, seconds_of(clock) - before);
  }
  return least;
}

#if defined(__clang__)
constexpr const char* compiler = __VERSION__;
#else
constexpr const char* compiler = "GCC " __VERSION__;
#endif

volatile double sink;  ///< keeps results that nobody reads from being left out

constexpr int chains = 12;  ///< independent ones, to fill two units with a latency of five cycles
constexpr long turns = 2'000'000;

#if defined(__x86_64__)

__attribute__((target("fma"))) void scalar_chains() {
  __m128d sums[chains];
  const __m128d factor = _mm_set_sd(0.999999), term = _mm_set_sd(1e-6);
  for (int c = 0; c < chains; ++c) sums[c] = _mm_set_sd(c);
  for (long i = 0; i < turns; ++i) {
#pragma GCC unroll 12
    for (int c = 0; c < chains; ++c) sums[c] = _mm_fmadd_sd(sums[c], factor, term);
  }
  for (int c = 1; c < chains; ++c) sums[0] = _mm_add_sd(sums[0], sums[c]);
  sink = _mm_cvtsd_f64(sums[0]);
}

__attribute__((target("avx2,fma"))) void avx2_chains() {
  __m256d sums[chains];
  const __m256d factor = _mm256_set1_pd(0.999999), term = _mm256_set1_pd(1e-6);
  for (int c = 0; c < chains; ++c) sums[c] = _mm256_set1_pd(c);
  for (long i = 0; i < turns; ++i) {
#pragma GCC unroll 12
    for (int c = 0; c < chains; ++c) sums[c] = _mm256_fmadd_pd(sums[c], factor, term);
  }
  for (int c = 1; c < chains; ++c) sums[0] = _mm256_add_pd(sums[0], sums[c]);
  sink = _mm256_cvtsd_f64(sums[0]);
}

__attribute__((target("avx512f"))) void avx512_chains() {
  __m512d sums[chains];
  const __m512d factor = _mm512_set1_pd(0.999999), term = _mm512_set1_pd(1e-6);
  for (int c = 0; c < chains; ++c) sums[c] = _mm512_set1_pd(c);
  for (long i = 0; i < turns; ++i) {
#pragma GCC unroll 12
    for (int c = 0; c < chains; ++c) sums[c] = _mm512_fmadd_pd(sums[c], factor, term);
  }
  for (int c = 1; c < chains; ++c) sums[0] = _mm512_add_pd(sums[0], sums[c]);
  sink = _mm512_cvtsd_f64(sums[0]);
}

/// GFLOP/s in double precision; a fused multiply-add counts as two. 0 where the processor has no such lanes.
double rate(bool available, void (*work)(), int lanes) {
  if (!available) return 0;
  return 2e-9 * static_cast<double>(chains) * static_cast<double>(turns) * lanes /
         least_seconds(CLOCK_THREAD_CPUTIME_ID, work);
}

#endif

/// a = b + s c over arrays far larger than the caches, GB/s of what the loop names: two reads and a write.
double triad(int threads) {
  constexpr long count = 40'000'000;  // 320 MB each
  std::vector<double> a(count), b(count), c(count);
  const auto each = [&](const auto& visit) {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (long i = 0; i < count; ++i) visit(static_cast<std::size_t>(i));
  };
  each([&](std::size_t i) { a[i] = 0, b[i] = 1, c[i] = 2; });
  const clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  const double time = least_seconds(clock, [&] { each([&](std::size_t i) { a[i] = b[i] + 3 * c[i]; }); });
  sink = a[count / 2];
  return 3e-9 * sizeof(double) * count / time;
}

}  // namespace

int main() {
  double scalar = 0, avx2 = 0, avx512 = 0;
#if defined(__x86_64__)
  const bool fma = __builtin_cpu_supports("fma") != 0;
  scalar = rate(fma, scalar_chains, 1);
  avx2 = rate(fma && __builtin_cpu_supports("avx2") != 0, avx2_chains, 4);
  avx512 = rate(__builtin_cpu_supports("avx512f") != 0, avx512_chains, 8);
#endif
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::printf(R"({"compiler": "%s", "scalar_gflops": %.3g, "avx2_gflops": %.3g, "avx512_gflops": %.3g, )"
              R"("triad_gb_per_s": %.3g, "threads": %d, "triad_all_gb_per_s": %.3g})"
              "\n",
              compiler, scalar, avx2, avx512, triad(1), threads, triad(threads));
  return 0;
}
