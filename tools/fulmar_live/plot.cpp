// SPDX-License-Identifier: BSD-3-Clause
// `fulmar plot`: numbers of a running flight, or of logs, over time, in the terminal.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "core/types/text.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_live/canvas.hpp"
#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/ports.hpp"
#include "tools/fulmar_live/screen.hpp"
#include "tools/fulmar_live/session.hpp"
#include "tools/fulmar_log/plot_log.hpp"

namespace fulmar::core {
namespace {

struct Curve {
  PortField port;
  FieldRef field;
  double factor = 1;  // radians are shown in degrees
};

/// True when a name in a path like "rates_radps.roll" or "angles_rad[2]" has this ending.
bool a_name_ends(const std::string& path, const std::string& ending) {
  for (std::size_t at = path.find(ending); at != std::string::npos; at = path.find(ending, at + 1)) {
    const std::size_t behind = at + ending.size();
    if (behind == path.size() || path[behind] == '.' || path[behind] == '[') return true;
  }
  return false;
}

/// "deg/s" of "rates_radps.roll"; "" when no part of the name is in radians.
std::string degrees_unit(const std::string& field) {
  for (const auto& [ending, unit] :
       {std::pair{"_rad", "deg"}, std::pair{"_radps", "deg/s"}, std::pair{"_radps2", "deg/s2"}})
    if (a_name_ends(field, ending)) return unit;
  return "";
}

Curve find_curve(Session& session, const std::string& name, Series& series) {
  Curve curve{find_port(session, name), {}, 1};
  if (curve.port.field.empty()) {
    std::vector<std::string> fields;
    for (const Field& f : curve.port.type->fields) fields.push_back(shown_name(f.name));
    throw Error(remote_messages::message_field_expected(
        name, curve.port.label, fields.empty() ? "FIELD" : fields.front(), join(fields)));
  }
  curve.field = resolve_field(*curve.port.type, curve.port.field);
  const fulmar_kind kind = curve.field.field->kind;
  if (kind == FULMAR_TEXT || kind == FULMAR_STRUCT)
    throw Error(remote_messages::numeric_field_expected(curve.port.label));
  series.label = curve.port.label;
  series.unit = curve.field.unit;
  if (const std::string unit = degrees_unit(curve.port.field); !unit.empty()) {
    curve.factor = 180 / std::numbers::pi;
    series.unit = unit;
  }
  return curve;
}

class Plot {
 public:
  Plot(Session& session, const PlotOptions& options)
      : session_(session),
        seconds_(options.seconds),
        series_(options.fields.size()),
        live_(isatty(STDOUT_FILENO) != 0) {
    for (std::size_t i = 0; i < options.fields.size(); ++i)
      curves_.push_back(find_curve(session, options.fields[i], series_[i]));
    epoch_ns_ = session.epoch_ns();
    for (const Curve& curve : curves_) session.subscribe(curve.port.topic);
  }

  /// Runs at a terminal until interrupted; otherwise for the requested time.
  void run() {
    std::optional<Screen> screen;
    if (live_) screen.emplace();
    auto drawn = std::chrono::steady_clock::now();
    while (!interrupted && (live_ || last_s_ - first_s_ < seconds_)) {
      if (const auto sample = session_.next(std::chrono::milliseconds(50))) take(*sample);
      const auto now = std::chrono::steady_clock::now();
      if (!live_ || now - drawn < std::chrono::milliseconds(100)) continue;
      drawn = now;
      screen->show(draw_plot(series_, last_s_, seconds_, terminal_size()));
    }
  }

  void finish() const {
    PlotSize size = terminal_size();
    size.rows = std::min(size.rows, 24);
    std::fputs(draw_plot(series_, last_s_, seconds_, size).c_str(), stdout);
    std::fflush(stdout);
  }

 private:
  void take(const Session::Sample& sample) {
    const double time_s = static_cast<double>(sample.time_ns - epoch_ns_) * 1e-9;
    if (!begun_ || time_s < last_s_ - 1) {  // a restarted host begins at 0
      for (Series& s : series_) s.points.clear();
      first_s_ = time_s;
      begun_ = true;
      last_s_ = time_s;
    }
    last_s_ = std::max(last_s_, time_s);
    const Type& type = *session_.type(sample.topic);
    message_.resize(type.size);
    cdr_decode(type, sample.bytes.data(), sample.bytes.size(), message_.data());
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      if (curves_[i].port.topic != sample.topic) continue;
      const FieldRef& f = curves_[i].field;
      const double value = f.present(message_.data())
                               ? number_at(*f.field, message_.data() + f.offset) * curves_[i].factor
                               : NAN;
      series_[i].points.emplace_back(time_s, value);
      while (series_[i].points.front().first < time_s - seconds_) series_[i].points.pop_front();
    }
  }

  Session& session_;
  double seconds_;
  std::vector<Series> series_;
  std::vector<Curve> curves_;
  bool live_, begun_ = false;
  double first_s_ = 0, last_s_ = 0;
  std::int64_t epoch_ns_ = 0;
  std::vector<std::byte> message_;
};

}  // namespace

int plot_command(const LiveAddress& target, const PlotOptions& options) {
  Session session(target);
  Plot plot(session, options);
  catch_interrupts();
  std::string why;
  try {
    plot.run();
  } catch (const FlightEnded& end) {
    why = for_terminal(end.what());
  }
  plot.finish();
  if (!why.empty()) std::fprintf(stderr, "%s\n", why.c_str());
  return interrupted ? 130 : 0;
}

int picture_command(const plot::LogPlotArguments& words) {
  std::vector<std::string> notes;
  const chart::Figure figure = plot::log_figure(words, notes);
  double begin_s = INFINITY, end_s = -INFINITY;
  for (const chart::FigurePanel& panel : figure.panels)
    for (const chart::FigureCurve& curve : panel.curves)
      for (const chart::ChartPoint& p : curve.points)
        if (std::isfinite(p.x)) {
          begin_s = std::min(begin_s, p.x);
          end_s = std::max(end_s, p.x);
        }
  PlotSize size = terminal_size();
  size.rows = std::clamp(size.rows / static_cast<int>(figure.panels.size()), 12, 24);
  for (const chart::FigurePanel& panel : figure.panels) {
    std::vector<Series> series;
    for (const chart::FigureCurve& curve : panel.curves) {
      series.push_back({for_terminal(curve.name), "", {}});
      for (const chart::ChartPoint& p : curve.points)
        if (std::isfinite(p.x)) series.back().points.emplace_back(p.x, p.y);
    }
    std::fputs(draw_plot(series, end_s, std::max(end_s - begin_s, 1e-3), size).c_str(), stdout);
  }
  for (const std::string& note : notes) std::fprintf(stderr, "%s\n", for_terminal(note).c_str());
  return 0;
}

}  // namespace fulmar::core
