// SPDX-License-Identifier: BSD-3-Clause
// Each shape against its closed form.
#include <complex>
#include <initializer_list>

#include "kit.hpp"

using fulmar::signal::Shape;
using fulmar::signal::Waveform;
namespace waveform_test {

using kit::signal_of;

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// As a component at 1/dt samples it, from its beginning to its end.
std::vector<double> sampled(const Waveform& w, double dt) {
  std::vector<double> x;
  for (int i = 0; i * dt < w.end_s() - 1e-6; ++i) x.push_back(w.at(i * dt));
  return x;
}
double sum(const std::vector<double>& x) {
  double s = 0;
  for (const double v : x) s += v;
  return s;
}
/// Of sum x e^(-2 pi i k n / N), times 2/N: the amplitude of the k-th harmonic.
double amplitude(const std::vector<double>& x, int k) {
  std::complex<double> s = 0;
  const double n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    s += x[i] * std::polar(1.0, -turn * k * static_cast<double>(i) / n);
  return std::abs(s) * 2 / n;
}

}  // namespace

TEST_CASE("every shape is within -1 and 1, and exactly 0 before its beginning and from its end on") {
  for (const Shape shape : {Shape::none, Shape::step, Shape::doublet, Shape::square, Shape::sine,
                            Shape::chirp, Shape::d3211, Shape::multisine}) {
    CAPTURE(static_cast<int>(shape));
    const Waveform w(signal_of(shape, 7.3));
    double most = 0;
    for (int i = 0; i <= 7400; ++i) most = std::max(most, std::abs(w.at(i * 0.001)));
    CHECK(most <= 1);
    CHECK((most > 0.9) == (shape != Shape::none));
    for (const double t : {-1.0, -0.001, w.end_s(), w.end_s() + 0.001, 1000.0}) {
      CAPTURE(t);
      CHECK(w.at(t) == 0);
    }
  }
}

TEST_CASE("a step stands for its duration; a doublet is as long up as down, whatever the duration") {
  CHECK(sum(sampled(Waveform(signal_of(Shape::step, 1.5)), 0.01)) == 150);
  for (const double duration : {0.2, 0.7, 1.4, 2.0, 2.2, 4.6}) {
    CAPTURE(duration);
    const std::vector<double> x = sampled(Waveform(signal_of(Shape::doublet, duration)), 0.01);
    CHECK(x.size() == static_cast<std::size_t>(std::lround(duration * 100)));
    CHECK(sum(x) == 0);
    CHECK(x.front() == 1);
    CHECK(x.back() == -1);
  }
}

TEST_CASE("3-2-1-1: three units up, two down, one up, one down: the area of one unit is left") {
  const Waveform w(signal_of(Shape::d3211, 2.1));
  const double units[] = {1, 1, 1, -1, -1, 1, -1};
  for (int i = 0; i < 7; ++i) {
    CAPTURE(i);
    for (const double within : {0.0, 0.15, 0.299}) CHECK(w.at(0.3 * i + within) == units[i]);
  }
  const std::vector<double> x = sampled(w, 0.01);
  CHECK(x.size() == 210);
  CHECK(sum(x) == 30);
}

TEST_CASE("square and sine are whole periods, as many as fit and at least one, with mean 0") {
  const Waveform square(signal_of(Shape::square, 4.9, 0.5)), sine(signal_of(Shape::sine, 4.9, 0.5));
  CHECK(square.end_s() == 4);
  CHECK(sine.end_s() == 4);
  CHECK(Waveform(signal_of(Shape::sine, 0.5, 0.5)).end_s() == 2);
  CHECK(Waveform(signal_of(Shape::sine, 3, 0.1 + 0.2)).end_s() == doctest::Approx(1 / 0.3));
  CHECK(Waveform(signal_of(Shape::sine, 10, 0.7)).end_s() == doctest::Approx(10));  // 7 periods, not 6.999
  CHECK(sum(sampled(square, 0.01)) == 0);
  CHECK(square.at(0.5) == 1);
  CHECK(square.at(1.5) == -1);
  CHECK(square.at(3.999) == -1);
  CHECK(sum(sampled(sine, 0.01)) == doctest::Approx(0).epsilon(1e-9));
  CHECK(sine.at(0.5) == doctest::Approx(1));
  CHECK(sine.at(0) == 0);
  CHECK(sine.at(1.0 / 6) == doctest::Approx(0.5));  // sin(2 pi 0.5 / 6)
}

TEST_CASE("a chirp's frequency is f0 (f1/f0)^(t/T), up and down, and its ends are faded") {
  for (const auto& band : {std::pair{0.2, 5.0}, {5.0, 0.2}, {1.0, 1.0}}) {
    const double f0 = band.first, f1 = band.second;
    const Waveform w(signal_of(Shape::chirp, 20, f0, f1));
    CAPTURE(f0);
    for (double t = 1; t < 19; t += 1.7) {
      CAPTURE(t);
      const double f = (w.chirp_phase(t + 1e-4) - w.chirp_phase(t - 1e-4)) / 2e-4 / turn;
      CHECK(f == doctest::Approx(f0 * std::pow(f1 / f0, t / 20)).epsilon(1e-6));
      CHECK(w.at(t) == doctest::Approx(std::sin(w.chirp_phase(t))).epsilon(1e-9));
    }
    // the cosine fade is over a twentieth of it: half at 0.5 s
    CHECK(w.at(0.5) == doctest::Approx(0.5 * std::sin(w.chirp_phase(0.5))));
    CHECK(std::abs(w.at(0.001)) < 1e-4);
    CHECK(std::abs(w.at(19.999)) < 1e-4);
  }
}

TEST_CASE("a multisine has the harmonics between its frequencies, all alike, and no other") {
  const Waveform w(signal_of(Shape::multisine, 10, 0.2, 2));
  REQUIRE(w.harmonics() == 19);  // 2/10 to 20/10 Hz
  CHECK(w.harmonic(0) == doctest::Approx(0.2));
  CHECK(w.harmonic(18) == doctest::Approx(2));
  const std::vector<double> x = sampled(w, 0.01);
  REQUIRE(x.size() == 1000);
  const double a = amplitude(x, 2);
  CHECK(a > 0.15);
  for (int k = 0; k <= 40; ++k) {
    CAPTURE(k);
    CHECK(amplitude(x, k) == doctest::Approx(k >= 2 && k <= 20 ? a : 0).epsilon(1e-6).scale(1));
  }
  // Schroeder: the peak over the root mean square; of equal phases it is sqrt(2 n) = 6.2
  double squares = 0;
  for (const double v : x) squares += v * v;
  const double rms = std::sqrt(squares / 1000), peak = *std::max_element(x.begin(), x.end());
  CHECK(peak > 0.85);
  CHECK(1 / rms < 2);
  // begins and ends at 0, rising
  CHECK(std::abs(x.front()) < 1e-6);
  CHECK(x[1] > 0);
  CHECK(std::abs(w.at(10 - 1e-5)) < 1e-3);
}

TEST_CASE("two multisines with every second harmonic, one harmonic apart, do not see each other") {
  auto p = signal_of(Shape::multisine, 10, 0.2, 2);
  p.every.value = 2;
  const Waveform even(p);
  p.frequency.value = 0.3;
  const Waveform odd(p);
  CHECK(even.harmonics() == 10);
  CHECK(odd.harmonics() == 9);
  const std::vector<double> x = sampled(even, 0.01), y = sampled(odd, 0.01);
  double product = 0;
  for (std::size_t i = 0; i < x.size(); ++i) product += x[i] * y[i];
  CHECK(product == doctest::Approx(0).epsilon(1e-9));
  for (int k = 2; k <= 20; ++k) {
    CAPTURE(k);
    CHECK((amplitude(x, k) > 0.1) == (k % 2 == 0));
    CHECK((amplitude(y, k) > 0.1) == (k % 2 == 1));
  }
}

TEST_CASE("more harmonics than there is room for: fewer of them, over the same band") {
  const Waveform w(signal_of(Shape::multisine, 100, 0.1, 5));  // 491
  CHECK(w.harmonics() <= Waveform::max_harmonics);
  CHECK(w.harmonics() > Waveform::max_harmonics / 2);
  CHECK(w.harmonic(0) == doctest::Approx(0.1));
  CHECK(w.harmonic(w.harmonics() - 1) > 4.8);
  CHECK(Waveform(signal_of(Shape::multisine, 2, 0.6, 0.9)).harmonic(0) == 1);  // none in the band: the next
}

}  // namespace waveform_test
