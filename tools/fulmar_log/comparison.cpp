// SPDX-License-Identifier: BSD-3-Clause
// See comparison.hpp.
#include "tools/fulmar_log/comparison.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

#include "core/types/named.hpp"
#include "fulmar/msg/filter_check.hpp"
#include "tools/fulmar_log/pairing.hpp"
#include "tools/fulmar_log/quantities.hpp"

namespace fulmar::states {
namespace {

using core::McapFile;
using TakeState = std::function<void(std::int64_t valid_ns, const VehicleState&)>;

constexpr std::int64_t at_the_end = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t oldest_check_ns = 2'000'000'000;

/// Initial state for fields that a log lacks.
VehicleState lacking(double std) {
  VehicleState s;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  s.position_std_m = s.velocity_std_mps = s.attitude_std_rad = s.wind_std_mps = {std, std, std};
  s.airspeed_std_mps = std;
  return s;
}

Errors no_errors() {
  Errors e;
  e.all.resize(quantities().size());
  e.claimed.resize(quantities().size());
  return e;
}

/// The searched topic.
const StateLog::Topic& of(const Side& side, const std::string& topic) { return *side.log->find(topic); }

/// True when the first side sets the times: the one with the lower rate, or at equal rates the one with more
/// samples, so that gaps of the other count.
bool first_says_when(const StateLog::Topic& a, const StateLog::Topic& b) {
  if (a.sparser_than(b) || b.sparser_than(a)) return a.sparser_than(b);
  return a.messages >= b.messages;
}

/// One side while the log is read: the estimate and its reference.
class OneSide {
 public:
  OneSide(const Side& side, const Span& span, Judged& out)
      : side_(side), span_(span), out_(out), stream_(side.log->file) {
    out_.errors = no_errors();
    if (!side.truth.empty()) truth_says_when_ = of(side, side.truth).sparser_than(of(side, side.topic));
    ahead_ = next();
  }
  TakeState on_state, on_truth;
  TakeError on_error;

  std::int64_t next_ns() const { return ahead_ ? flight_ns(ahead_->log_ns) : at_the_end; }
  void step() {
    const std::int64_t now_ns = next_ns(), valid_ns = flight_ns(ahead_->publish_ns);
    const std::string& topic = topic_of(*ahead_);
    if (topic == side_.topic) take_state(valid_ns);
    if (topic == side_.truth) take_truth(valid_ns);
    if (topic == side_.fixes) fixes_.add_sparse(valid_ns, read(fix_reader_, Gnss()));
    if (topic == side_.check) {
      check_ = read(check_reader_, FilterCheck());
      check_ns_ = valid_ns;
    }
    const auto truth = [this](const auto& sparse, const auto& dense) { by_truth(sparse, dense); };
    const auto fix = [this](const auto& sparse, const auto& dense) { by_fix(sparse, dense); };
    truths_.settle(now_ns, truth);
    fixes_.settle(now_ns, fix);
    ahead_ = next();
    if (ahead_) return;
    truths_.end(truth);
    fixes_.end(fix);
  }

 private:
  const std::string& topic_of(const McapFile::Message& m) const {
    return stream_.log().channels.at(m.channel).topic;
  }
  std::int64_t flight_ns(std::uint64_t ns) const {
    return static_cast<std::int64_t>(ns - side_.log->epoch_ns);
  }

  const McapFile::Message* next() {
    const McapFile::Message* m = stream_.next();
    while (m) {
      const std::string& topic = topic_of(*m);
      if (topic == side_.topic || topic == side_.truth || topic == side_.fixes || topic == side_.check) break;
      m = stream_.next();
    }
    return m;
  }

  template <class Message>
  Message read(std::unique_ptr<MessageReader<Message>>& reader, const Message& without) {
    if (!reader) reader = std::make_unique<MessageReader<Message>>(stream_.log(), ahead_->channel, without);
    return reader->read(ahead_->data);
  }

  void take_state(std::int64_t valid_ns) {
    if (!span_.holds(valid_ns)) return;
    VehicleState state = read(state_reader_, lacking(unknown_std));
    if (out_.samples > 0 && valid_ns <= out_.last_ns) {
      ++out_.not_new;
      return;
    }
    if (out_.samples++ == 0) out_.first_ns = valid_ns;
    out_.last_ns = valid_ns;
    if (!drop_not_finite(state)) ++out_.not_finite;
    if (side_.truth.empty())
      fixes_.add_dense(valid_ns, state);
    else if (truth_says_when_)
      truths_.add_dense(valid_ns, state);
    else
      truths_.add_sparse(valid_ns, state);
    if (on_state) on_state(valid_ns, state);
  }
  void take_truth(std::int64_t valid_ns) {
    VehicleState truth = read(truth_reader_, lacking(0));
    truth.position_std_m = truth.velocity_std_mps = truth.attitude_std_rad = truth.wind_std_mps = {};
    truth.airspeed_std_mps = 0;
    drop_not_finite(truth);
    if (truth_says_when_)
      truths_.add_sparse(valid_ns, truth);
    else
      truths_.add_dense(valid_ns, truth);
    if (on_truth) on_truth(valid_ns, truth);
  }

  void by_truth(const VehicleState& sparse, const VehicleState& dense) {
    const VehicleState& truth = truth_says_when_ ? sparse : dense;
    const VehicleState& state = truth_says_when_ ? dense : sparse;
    judge(truths_.pair_ns(), frame_.seen_from(truth, state), state);
  }
  void by_fix(const Gnss& fix, const VehicleState& state) {
    judge(fixes_.pair_ns(), frame_.seen_from(fix, state), state);
  }

  void judge(std::int64_t valid_ns, const VehicleState& reference, const VehicleState& state) {
    Errors& e = out_.errors;
    ++e.pairs;
    for (std::size_t i = 0; i < quantities().size(); ++i) {
      const Quantity& q = quantities()[i];
      if (!q.is_valid(reference) || !q.is_valid(state)) continue;
      const double error = q.difference(state, reference);
      e.all[i].add(error);
      const bool claimed = q.has_claim(state) && q.has_claim(reference);
      const double claim =
          claimed ? std::hypot(q.claim(state), q.claim(reference)) : std::numeric_limits<double>::quiet_NaN();
      if (claimed) e.claimed[i].add(error, claim);
      if (on_error) on_error(valid_ns, i, error, claim);
    }
    if (!side_.truth.empty()) add_nees(reference, state);
  }
  void add_nees(const VehicleState& truth, const VehicleState& state) {
    const consistency::Nees::Errors std = consistency::Nees::claims(state);
    const bool all_there = truth.attitude_valid && truth.velocity_valid && truth.position_valid &&
                           truth.height_valid && state.attitude_valid && state.velocity_valid &&
                           state.position_valid && state.height_valid && std.minCoeff() > 0 &&
                           std.maxCoeff() < 0.1 * unknown_std;
    if (!all_there) return;
    const bool knows = !side_.check.empty() && check_ns_ && out_.last_ns - *check_ns_ < oldest_check_ns;
    if (!side_.check.empty() && !knows) return;
    const double nees = consistency::Nees::of(consistency::Nees::errors(truth, state), std,
                                              knows ? check_.correlation_ratio : std::array<double, 36>{});
    if (!std::isfinite(nees)) return;
    out_.errors.nees.add(nees);
    ++out_.errors.nees_n;
    out_.errors.correlated = knows;
  }

  const Side& side_;
  const Span& span_;
  Judged& out_;
  core::McapStream stream_;
  const McapFile::Message* ahead_ = nullptr;
  bool truth_says_when_ = false;
  std::unique_ptr<MessageReader<VehicleState>> state_reader_, truth_reader_;
  std::unique_ptr<MessageReader<Gnss>> fix_reader_;
  std::unique_ptr<MessageReader<FilterCheck>> check_reader_;
  Pairing<VehicleState> truths_;
  Pairing<Gnss> fixes_;
  CommonFrame frame_;
  FilterCheck check_;
  std::optional<std::int64_t> check_ns_;
};

/// Two streams, one of each side; the one with fewer samples sets the times.
class TwoSides {
 public:
  explicit TwoSides(bool first_says_when) : first_says_when_(first_says_when) {}
  TakeState taker(bool of_first) {
    return [this, of_first](std::int64_t valid_ns, const VehicleState& state) {
      if (of_first == first_says_when_)
        pairs_.add_sparse(valid_ns, state);
      else
        pairs_.add_dense(valid_ns, state);
    };
  }
  template <class Take>
  void settle(std::int64_t now_ns, const Take& take) {
    const auto in_order = [&](const VehicleState& sparse, const VehicleState& dense) {
      first_says_when_ ? take(sparse, dense) : take(dense, sparse);
    };
    now_ns == at_the_end ? pairs_.end(in_order) : pairs_.settle(now_ns, in_order);
  }
  std::uint64_t paired() const { return pairs_.paired(); }
  std::uint64_t alone() const { return pairs_.alone(); }

 private:
  bool first_says_when_;
  Pairing<VehicleState> pairs_;
};

bool all_zero(const std::vector<Moments>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Moments& m) { return m.squares == 0; });
}

}  // namespace

Comparison compare(const Side& first, const Side& second, const Span& span) {
  Comparison out;
  out.difference.resize(quantities().size());
  OneSide a(first, span, out.first), b(second, span, out.second);
  TwoSides states(first_says_when(of(first, first.topic), of(second, second.topic))), truths(true);
  a.on_state = states.taker(true);
  b.on_state = states.taker(false);
  const bool two_truths =
      first.log->file != second.log->file && !first.truth.empty() && !second.truth.empty();
  if (two_truths) {
    a.on_truth = truths.taker(true);
    b.on_truth = truths.taker(false);
  }
  CommonFrame frame;
  double apart_m = 0;
  bool same_flags = true;
  const auto differ = [&](const VehicleState& one, const VehicleState& other) {
    const VehicleState seen = frame.seen_from(other, one);
    for (std::size_t i = 0; i < quantities().size(); ++i) {
      const Quantity& q = quantities()[i];
      if (q.is_valid(one) && q.is_valid(seen)) out.difference[i].add(q.difference(seen, one));
      same_flags = same_flags && q.is_valid(one) == q.is_valid(seen);
    }
  };
  const auto part = [&](const VehicleState& one, const VehicleState& other) {
    const Vec3<Ned> way = frame.seen_from(other, one).position_m - one.position_m;
    apart_m = std::max(apart_m, std::hypot(way.north, way.east, way.down));
  };
  for (std::int64_t now_ns = 0; now_ns != at_the_end;) {
    now_ns = std::min(a.next_ns(), b.next_ns());
    if (now_ns != at_the_end) (a.next_ns() <= b.next_ns() ? a : b).step();
    states.settle(now_ns, differ);
    truths.settle(now_ns, part);
  }
  out.pairs = states.paired();
  out.times = states.paired() + states.alone();
  if (two_truths && apart_m > 0) out.truths_apart_m = apart_m;
  out.equal = all_zero(out.difference) && same_flags && states.alone() == 0 &&
              out.first.samples == out.second.samples;
  return out;
}

Judged judge(const Side& side, const TakeError& take, const Span& span) {
  Judged out;
  OneSide one(side, span, out);
  one.on_error = take;
  while (one.next_ns() != at_the_end) one.step();
  return out;
}

}  // namespace fulmar::states
