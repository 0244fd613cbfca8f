// SPDX-License-Identifier: BSD-3-Clause
// Role and sign of each control. A file has neither: the sign depends on the user's gains and on the hinge of
// each tool.
#include <algorithm>
#include <cmath>

#include "tools/fulmar_aero/import/aircraft.hpp"
#include "tools/fulmar_aero/import/lines.hpp"
#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

const char* role_name(Role role) {
  constexpr std::array<const char*, 5> names{"aileron", "elevator", "rudder", "flap", "mixed"};
  return names[std::size_t(role)];
}

/// The main response of a role.
Force main_force(Role role) {
  return role == Role::elevator ? pitch : role == Role::rudder ? yaw : role == Role::flap ? lift : roll;
}

std::optional<Role> role_by_name(const std::string& name) {
  const std::string text = lower(name);
  const auto has = [&](const char* part) { return text.find(part) != std::string::npos; };
  if (has("elevon") || has("ruddervator") || has("flaperon") || has("taileron")) return Role::mixed;
  if (has("ail")) return Role::aileron;
  if (has("elev")) return Role::elevator;
  if (has("rud")) return Role::rudder;
  if (has("flap")) return Role::flap;
  return {};
}

/// Role by the response, when the name gives none. A symmetric surface has no lateral moment; one with both
/// is one half of a pair.
Role role_by_response(const Control& control) {
  const double m = std::abs(control.of[pitch].x), l = std::abs(control.of[roll].x),
               n = std::abs(control.of[yaw].x);
  const double side = std::max(l, n);
  if (m > 5 * side) return Role::elevator;
  if (side > 5 * m) return l > n ? Role::aileron : Role::rudder;
  return Role::mixed;
}

void add(Column& to, const Column& of, double sign, const std::string& why) {
  for (std::size_t i = 0; i < forces; ++i) {
    if (!of[i].known) continue;
    if (!to[i].known) {
      to[i] = of[i];
      to[i].x *= sign;
      if (sign < 0 && to[i].x != 0) to[i].from += ", sign turned";
      continue;
    }
    to[i].x += sign * of[i].x;
    to[i].from += why;
  }
}

std::string reported(const Control& control) {
  return control.name.empty() ? aero_messages::unnamed_control(control.where.text()).line()
                              : "'" + control.name + "'";
}

/// Sets the sign of the whole column so that its main response has the sign of the convention.
void set_sign(Column& column, Role role, const std::string& who, std::vector<std::string>& notes) {
  const double main = column[main_force(role)].x;
  const bool right = role == Role::aileron || role == Role::flap ? main >= 0 : main <= 0;
  if (right) return;
  for (Value& value : column) {
    if (!value.known || value.x == 0) continue;
    value.x = -value.x;
    value.from += ", sign turned";
  }
  const char* const positive = role == Role::aileron    ? "rolls right"
                               : role == Role::elevator ? "moves trailing edge and nose down"
                               : role == Role::rudder   ? "moves trailing edge and nose left"
                                                        : "lifts";
  notes.push_back(aero_messages::control_sign_turned(role_name(role), who, positive));
}

struct Sorted {
  std::array<std::vector<const Control*>, 5> by_role;
};

/// Two halves of a pair: the sum in which the main response adds, and the difference.
void join_pair(const Control& a, const Control& b, Force main, Column& together, Column* apart) {
  const double sign = a.of[main].x * b.of[main].x < 0 ? -1 : 1;
  const std::string why = " and " + (b.name.empty() ? "the other half" : b.name);
  add(together, a.of, 1, "");
  add(together, b.of, sign, why);
  if (!apart) return;
  add(*apart, a.of, 1, "");
  add(*apart, b.of, -sign, why);
}

void take_role(const std::vector<const Control*>& all, Role role, ControlColumns& out) {
  if (all.empty()) return;
  Column column;
  if (all.size() == 1) {
    column = all[0]->of;
  } else {
    std::string names = reported(*all[0]);
    column = all[0]->of;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Force main = main_force(role);
      const double sign = column[main].x * all[i]->of[main].x < 0 ? -1 : 1;
      add(column, all[i]->of, sign, " and " + all[i]->name);
      names += " and " + reported(*all[i]);
    }
    out.notes.push_back(std::string(role_name(role)) + ": " + names + " move together");
  }
  set_sign(column, role, reported(*all[0]), out.notes);
  out.of[std::size_t(role)] = column;
  out.known[std::size_t(role)] = true;
}

void take_pair(const Control& a, const Control& b, ControlColumns& out) {
  Column together, apart;
  join_pair(a, b, pitch, together, &apart);
  const Role other = std::abs(apart[yaw].x) > std::abs(apart[roll].x) ? Role::rudder : Role::aileron;
  set_sign(together, Role::elevator, "the sum", out.notes);
  set_sign(apart, other, "the difference", out.notes);
  out.of[std::size_t(Role::elevator)] = together;
  out.of[std::size_t(other)] = apart;
  out.known[std::size_t(Role::elevator)] = out.known[std::size_t(other)] = true;
  (other == Role::rudder ? out.v_tail : out.elevons) = true;
  out.notes.push_back(reported(a) + " and " + reported(b) + " are " +
                      (other == Role::rudder ? "a V-tail" : "elevons") + ": elevator is their sum, " +
                      role_name(other) + " their difference");
}

}  // namespace

Role role_of(const Control& control) {
  const std::optional<Role> by_name = role_by_name(control.name);
  return by_name ? *by_name : role_by_response(control);
}

ControlColumns control_columns(const std::vector<Control>& controls) {
  ControlColumns out;
  Sorted sorted;
  for (const Control& control : controls)
    if (const auto named = role_by_name(control.name))
      sorted.by_role[std::size_t(*named)].push_back(&control);
  const Sorted named = sorted;
  for (const Control& control : controls) {
    if (role_by_name(control.name)) continue;
    const std::size_t role = std::size_t(role_by_response(control));
    if (role == std::size_t(Role::mixed) || named.by_role[role].empty())
      sorted.by_role[role].push_back(&control);
    else  // a slat or a brake: no further elevator
      out.notes.push_back(reported(control) + " is left out: another control is the " +
                          role_name(Role(role)) + " by its name");
  }
  std::vector<const Control*>& mixed = sorted.by_role[std::size_t(Role::mixed)];
  if (mixed.size() == 2) {
    take_pair(*mixed[0], *mixed[1], out);
    mixed.clear();
  } else if (mixed.size() == 1) {
    // the only role that is still free
    Role missing = Role::mixed;
    int number = 0;
    for (const Role role : {Role::aileron, Role::elevator, Role::rudder})
      if (sorted.by_role[std::size_t(role)].empty()) {
        missing = role;
        ++number;
      }
    if (number == 1) {
      out.notes.push_back(reported(*mixed[0]) + " is taken as the " + role_name(missing) +
                          ", which no other control is");
      sorted.by_role[std::size_t(missing)].push_back(mixed[0]);
      mixed.clear();
    }
  }
  if (!mixed.empty()) refuse(mixed[0]->where, aero_messages::control_pair_incomplete(reported(*mixed[0])));
  for (const Role role : {Role::aileron, Role::elevator, Role::rudder, Role::flap})
    take_role(sorted.by_role[std::size_t(role)], role, out);
  for (const Role role : {Role::aileron, Role::elevator, Role::rudder}) {
    const std::size_t i = std::size_t(role);
    if (!out.known[i]) continue;
    const Column& column = out.of[i];
    const double main = std::abs(column[main_force(role)].x);
    const double most =
        std::max({std::abs(column[roll].x), std::abs(column[pitch].x), std::abs(column[yaw].x)});
    if (main > 0.1 * most) continue;
    refuse(sorted.by_role[i].empty() ? core::Where{"", 0} : sorted.by_role[i][0]->where,
           fulmar::located(std::string(role_name(role)),
                           aero_messages::control_ineffective(
                               force_symbol(main_force(role)), figures(main),
                               most > 0 ? aero_messages::control_column_swapped(figures(most))
                                        : aero_messages::control_gain_zero())));
  }
  return out;
}

}  // namespace fulmar::aero::imports
