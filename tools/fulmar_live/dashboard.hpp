// SPDX-License-Identifier: BSD-3-Clause
// Content of `fulmar watch`: a running flight on one screen of text, from the messages received so far.
#pragma once
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_live/canvas.hpp"

namespace fulmar::core {

class Dashboard {
 public:
  using json = nlohmann::json;
  /// `view`: the response of /fulmar/view.
  void take_view(json view);
  /// `topics`: each with its type, "VehicleState". Returns the topics to show, selected by the type of their
  /// messages because a mission may name its roles freely; of several the one of a role. Call after
  /// take_view.
  std::vector<std::string> choose(const std::map<std::string, std::string>& topics);
  /// `message`: from shown_json. `time_s`: of flight.
  void take(const std::string& topic, double time_s, const nlohmann::ordered_json& message);
  /// True when every chosen topic has a message.
  bool whole() const;

  /// Lines of text within the given size. `lost`: replaces the name and time of the flight when the data are
  /// old. Control characters from the flight are removed.
  std::string text(const PlotSize& size, const std::string& lost = "") const;

 private:
  struct Newest {
    std::string topic;
    nlohmann::ordered_json message = nlohmann::ordered_json::object();
    double time_s = -1e9;
  };
  enum class Look { plain, faint, good, bad, head };
  struct Cell {
    std::string name, words;
    Look look = Look::plain;
  };
  struct Line {
    std::string text;
    Look look = Look::plain;
  };
  struct Happened {
    std::string words, of;  // `of`: name of the parameter, for a change of one
    Look look = Look::plain;
  };

  const nlohmann::ordered_json& message(const std::string& type) const;
  double number(const std::string& type, const std::string& path) const;
  bool flag(const std::string& type, const std::string& field) const;
  std::string word(const std::string& type, const std::string& field) const;
  std::string asked_for(const std::string& type, const std::string& valid, const std::string& path,
                        const std::string& asked_type, const std::string& asked_path, int places,
                        const std::string& unit) const;

  std::vector<Cell> cells() const;
  std::vector<Cell> words() const;
  Cell control() const;
  Cell estimator() const;
  Cell sensors() const;
  Cell safety() const;
  Cell roles() const;
  Cell steps() const;
  std::string head() const;

  json view_ = json::object();
  std::map<std::string, Newest> newest_;  // by type
  std::deque<Happened> events_;           // newest first
  double now_s_ = -1e9;
};

}  // namespace fulmar::core
