// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/airframe_file.hpp"

#include <filesystem>
#include <vector>

#include "core/graph/record.hpp"
#include "core/graph/shipped.hpp"
#include "core/loader/table.hpp"
#include "fulmar/flight/math/tables.hpp"
#include "fulmar/flight/model/trim.hpp"
#include "fulmar/schema.hpp"
#include "fulmar/sim/airframe_rules.hpp"
#include "tools/fulmar_aero/messages.hpp"

namespace fulmar::aero {
namespace {

/// The item of a list for an index such as "[2]"; null for none.
const core::Node* item_of(const core::Node& list, const std::string& step) {
  const std::size_t bracket = step.find('[');
  if (bracket == std::string::npos) return nullptr;
  const std::size_t i = std::stoul(step.substr(bracket + 1));
  return i < list.items.size() ? &list.items[i] : nullptr;
}

/// The entry with a field's name, with or without its unit; nullptr when the file does not have it.
const core::Node::Entry* entry_of(const core::Node& map, const std::string& field) {
  const auto split = core::split_suffix(field);
  for (const core::Node::Entry& entry : map.entries)
    if (entry.key == field || (split && entry.key == split->name)) return &entry;
  return nullptr;
}

struct Positive {
  const char* field;
  double value;
  const char* unit;
};

void refuse_what_is_not_positive(const AirframeFile& file, core::Report& report) {
  const Airframe& a = file.airframe;
  const bool disc = a.propulsion.disc.area_m2 > 0;
  const std::vector<Positive> all{
      {"mass_kg", a.mass_kg, "kg"},
      {"inertia.xx_kgm2", a.inertia.xx_kgm2, "kg m^2"},
      {"inertia.yy_kgm2", a.inertia.yy_kgm2, "kg m^2"},
      {"inertia.zz_kgm2", a.inertia.zz_kgm2, "kg m^2"},
      {"wing.area_m2", a.wing.area_m2, "m^2"},
      {"wing.span_m", a.wing.span_m, "m"},
      {"wing.chord_m", a.wing.chord_m, "m"},
      {"wing.oswald_ratio", a.wing.oswald_ratio, ""},
      {"wing.stall_alpha_rad", a.wing.stall_alpha_rad, "rad"},
      {"wing.stall_sharpness_ratio", a.wing.stall_sharpness_ratio, ""},
      {"propulsion.propeller_diameter_m", disc ? 1 : a.propulsion.propeller_diameter_m, "m"},
      {"propulsion.cq0_ratio", disc ? 1 : a.propulsion.cq0_ratio, ""},
      {"propulsion.torque_constant_ratio", disc ? 1 : a.propulsion.torque_constant_ratio, ""},
      {"propulsion.resistance_ohm", disc ? 1 : a.propulsion.resistance_ohm, "ohm"},
      {"propulsion.battery_volt", a.propulsion.battery_volt, "V"},
      {"aileron.limit_rad", a.aileron.limit_rad, "rad"},
      {"elevator.limit_rad", a.elevator.limit_rad, "rad"},
      {"rudder.limit_rad", rudder_acts(a) ? a.rudder.limit_rad : 1, "rad"},
      {"limits.airspeed_cruise_mps", a.limits.airspeed_cruise_mps, "m/s"}};
  for (const Positive& one : all) {
    if (one.value > 0) continue;
    const std::string unit = *one.unit ? std::string(" ") + one.unit : "";
    report.add(file.where(one.field),
               located(std::string(one.field),
                       aero_messages::value_not_positive(core::number_text(one.value), unit)));
  }
}

void refuse_inertia(const AirframeFile& file, core::Report& report) {
  const Inertia& i = file.airframe.inertia;
  if (i.xx_kgm2 <= 0 || i.zz_kgm2 <= 0 || i.xz_kgm2 * i.xz_kgm2 < i.xx_kgm2 * i.zz_kgm2) return;
  report.add(file.where("inertia.xz_kgm2"),
             aero_messages::inertia_not_positive_definite(core::number_text(i.xz_kgm2 * i.xz_kgm2),
                                                          core::number_text(i.xx_kgm2 * i.zz_kgm2)));
}

void refuse_tables(const AirframeFile& file, core::Report& report) {
  const core::Node* const aero = file.root.find("aero");
  const core::Node* const tables = aero ? aero->find("tables") : nullptr;
  for (std::size_t i = 0; tables && i < tables->items.size(); ++i) {
    const std::string fault = table_fault(file.airframe.aero.tables[i]);
    if (fault.empty()) continue;
    const core::Node::Entry* const entry = entry_of(tables->items[i], fault.substr(0, fault.find(':')));
    report.add(entry ? entry->where() : tables->items[i].where(), aero_messages::table_invalid(i, fault));
  }
}

}  // namespace

std::string shown_field(const std::string& field) {
  std::string out;
  for (std::size_t begin = 0; begin <= field.size();) {
    const std::size_t dot = std::min(field.find('.', begin), field.size());
    const std::string step = field.substr(begin, dot - begin);
    const auto split = core::split_suffix(step);
    out += (out.empty() ? "" : ".") + (split ? split->name : step);
    begin = dot + 1;
  }
  return out;
}

core::Where AirframeFile::where(const std::string& field) const {
  core::Where at{name, 0};
  const core::Node* map = &root;
  for (std::size_t begin = 0; begin <= field.size();) {
    const std::size_t dot = std::min(field.find('.', begin), field.size());
    const std::string step = field.substr(begin, dot - begin);
    const core::Node::Entry* const entry = entry_of(*map, step.substr(0, step.find('[')));
    if (!entry) break;
    at = entry->where();
    map = &entry->value;
    if (const core::Node* const item = item_of(*map, step)) {
      at = item->where();
      map = item;
    }
    begin = dot + 1;
  }
  if (origin.empty()) return at;
  const auto found = origin.find(at.line);
  return found == origin.end() ? core::Where{name, 0} : found->second;
}

bool AirframeFile::says(const std::string& field) const {
  const std::size_t dot = field.find('.');
  const core::Node::Entry* const entry = entry_of(root, field.substr(0, dot));
  return entry && (dot == std::string::npos || entry_of(entry->value, field.substr(dot + 1)));
}

std::string AirframeFile::title() const {
  const std::string own(airframe.name.view());
  return own.empty() ? std::filesystem::path(name).filename().string() : own;
}

namespace {

AirframeFile airframe_in(const core::FilePtr& source, const std::string& name) {
  AirframeFile file;
  file.name = name;
  core::Report report;
  file.root = core::parse_yaml(source, report);
  if (report.empty() && !file.root.is(core::Node::Kind::map))
    report.add({name, 0}, aero_messages::airframe_map_expected(core::found_words(file.root)));
  if (report.empty())
    core::fill_record(*core::copy_type(describe<Airframe>()), file.root,
                      reinterpret_cast<std::byte*>(&file.airframe), "", report, {"params"});
  if (report.empty()) {
    refuse_what_is_not_positive(file, report);
    refuse_inertia(file, report);
    refuse_tables(file, report);
    if (const sim::AirframeFault fault = sim::airframe_fault(file.airframe))
      report.add(file.where(fault.field), located(shown_field(fault.field), fault.sentence));
  }
  report.throw_if_any();
  return file;
}

}  // namespace

AirframeFile read_airframe_file(const std::string& name) {
  return airframe_in(core::read_source(core::named_file(std::filesystem::path(), name), name), name);
}

AirframeFile airframe_of_text(const std::string& text, const std::string& name) {
  return airframe_in(std::make_shared<core::SourceFile>(core::SourceFile{name, name, text}), name);
}

}  // namespace fulmar::aero
