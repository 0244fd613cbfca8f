// SPDX-License-Identifier: BSD-3-Clause
// fulmar log compare: its choice of logs, states and references, and its messages when there are none.
#include "tools/fulmar_log/test/compare_kit.hpp"

namespace compare_choice_test {

using namespace compare_test;

TEST_CASE("a receiver beside the aircraft's own is the reference; --fixes and --truth choose") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  {
    Log out(log);
    for (int i = 0; i < 20; ++i) {
      out.write("/nav/state", i * 100 * ms, state());
      out.write("/second/state", i * 100 * ms, state());
      out.write("/vehicle/gnss", i * 100 * ms, Gnss());
      out.write("/reference/gnss", i * 100 * ms, Gnss());
    }
  }
  CHECK(compared(log).at("errors").at("first").at("fixes") == "/reference/gnss");
  CHECK(compared(log + " --fixes vehicle.gnss").at("errors").at("first").at("fixes") == "/vehicle/gnss");
  CHECK(
      compared(log + " --truth second").at("errors").at("first").at("truth").is_null());  // it is the second
  CHECK(say(log + " --fixes nav.state").text ==
        log +
            ": log_tool.topic_type_mismatch(/nav/state, VehicleState, Gnss,  [] /reference/gnss, "
            "/vehicle/gnss)");
  CHECK(say(log + " --fixes vehicle.gnss --truth second").code == 2);
}

TEST_CASE("a log of an older layout is read as far as it goes; fields that mean something else are refused") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap", other = folder.path / "b.mcap";
  const core::TypePtr now = core::copy_type(describe<VehicleState>());
  core::Type old = *now, feet = *now;
  std::erase_if(old.fields, [](const core::Field& f) {
    return f.name.find("_std_") != std::string::npos || f.name.ends_with("_valid") || f.name == "wind_mps";
  });
  for (core::Field& field : feet.fields)
    if (field.name == "airspeed_mps") {
      field.kind = FULMAR_F32;
      field.stride = 4;
    }
  {
    Log out(log), second(other);
    for (int i = 0; i < 20; ++i) {
      VehicleState s = state();
      out.write("/vehicle/truth", i * 100 * ms, s);
      s.position_m.north = 3;
      s.position_valid = false;
      out.write_as("/nav/state", old, i * 100 * ms, s);
      out.write("/second/state", i * 100 * ms, state());
      second.write_as("/nav/state", feet, i * 100 * ms, s);
      second.write("/second/state", i * 100 * ms, s);
    }
  }
  const json j = compared(log), first = j.at("errors").at("first").at("channels");
  CHECK(first.at("position_north_m").at("mean") == 3);  // no flag marks it as invalid
  CHECK(first.at("position_north_m").at("claimed").is_null());
  CHECK(j.at("errors").at("first").at("nees").is_null());
  CHECK(j.at("errors").at("second").at("channels").at("position_north_m").at("claimed") == 1);
  CHECK(say(other).text == "/nav/state: airspeed_mps: types.reader_differs(kind , f64, f32)");
}

TEST_CASE("which states: by port, topic or owner; what cannot be is told with what there is") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap", alone = folder.path / "b.mcap",
                    none = folder.path / "c.mcap";
  {
    Log out(log), one(alone), nothing(none);
    for (int i = 0; i < 20; ++i) {
      for (const char* topic : {"/nav/state", "/second/state", "/third/state", "/vehicle/truth"})
        out.write(topic, i * 100 * ms, state());
      one.write("/nav/state", i * 100 * ms, state());
      one.write("/vehicle/truth", i * 100 * ms, state());
      nothing.write("/vehicle/gnss", i * 100 * ms, Gnss());
    }
    out.write("/vehicle/gnss", 0, Gnss());
  }
  for (const char* words : {" second.state nav.state", " /second/state /nav/state", " second nav"}) {
    const json j = compared(log + words);
    CHECK(j.at("first").at("topic") == "/second/state");
    CHECK(j.at("second").at("topic") == "/nav/state");
    CHECK(j.at("first").at("name") == "second");
  }
  const std::string all = "/nav/state, /second/state, /third/state, /vehicle/truth";
  const auto refused = [](const std::string& words, const std::string& why) {
    const Said said = say(words);
    CHECK(said.code == 1);
    CHECK(said.text == why);
  };
  refused(log, log + ": log_tool.state_names_required(" + all + ")");
  refused(log + " nav second third", "log_tool.too_many_states(nav, second, third)");
  refused(log + " nav thrid.state", log +
                                        ": log_tool.topic_unknown(/thrid/state,  [/third/state] /nav/state, "
                                        "/second/state, /third/state, /vehicle/truth)");
  refused(log + " nav vehicle.gnss", log +
                                         ": log_tool.topic_type_mismatch(/vehicle/gnss, Gnss, VehicleState,  "
                                         "[] /nav/state, /second/state, /third/state, /vehicle/truth)");
  refused(alone, alone + ": log_tool.state_names_required(/nav/state, /vehicle/truth)");
  refused(none, none + ": log_tool.states_missing");
  refused(log + " " + (folder.path / "no.mcap").string(),
          "reading.file_not_readable(" + (folder.path / "no.mcap").string() + ", reading.file_missing)");
  const json by_truth =
      compared(alone + " nav vehicle.truth");  // one estimate and the truth: their difference
  CHECK(by_truth.at("errors").at("first").at("truth").is_null());
}

TEST_CASE("when nothing can be compared the exit code is 1, but for what asks for changes alone") {
  const Folder folder;
  const std::string a = folder.path / "a.mcap", b = folder.path / "b.mcap", c = folder.path / "c.mcap";
  {
    Log one(a), later(b), other(c);
    for (int i = 0; i < 20; ++i) {
      one.write("/nav/state", i * 100 * ms, state());
      later.write("/nav/state", (i + 1000) * 100 * ms, state());
      other.write("/second/state", i * 100 * ms, state());
    }
  }
  CHECK(say(a + " " + b).code == 1);
  CHECK(say(a + " " + a).code == 0);
  CHECK(say("--changed " + a + " " + b).code == 0);
  CHECK(say(a + " " + c).code == 1);
  CHECK(say(a + " " + c).text == "log_tool.common_estimate_missing");
  CHECK(say("--changed " + a + " " + c).code == 0);
  CHECK(compared(a + " " + c + " nav second").at("compared") == 20);
}

TEST_CASE("two logs: the states that both have, each beside its own truth; that these differ is told") {
  const Folder folder;
  const std::string a = folder.path / "a.mcap", b = folder.path / "b.mcap", c = folder.path / "c.mcap";
  const auto write = [](const std::string& file, double truth_m, double error_m) {
    write_three(file, 50, [&](int i, VehicleState& first, VehicleState& second, VehicleState& truth) {
      truth.position_m.north = truth_m * i;
      first.position_m.north = truth_m * i + error_m;
      second.position_m.north = truth_m * i;
    });
  };
  write(a, 1, 2);
  write(b, 1, 5);
  write(c, 1.1, 5);
  const json j = compared("--changed " + a + " " + b);  // second is the same in both
  CHECK(j.at("first").at("topic") == "/nav/state");
  CHECK(j.at("first").at("name") == "first");
  CHECK(j.at("truths_apart_m").is_null());
  CHECK(j.at("difference").at("position_north_m").at("mean") == 3);
  CHECK(j.at("errors").at("first").at("channels").at("position_north_m").at("rms") == 2);
  CHECK(j.at("errors").at("second").at("channels").at("position_north_m").at("rms") == 5);
  CHECK(json::parse(say("--json " + a + " " + b).text).at("estimates").size() == 2);
  const json apart = compared("--names old,new " + a + " " + c + " nav");
  CHECK(apart.at("truths_apart_m").get<double>() == doctest::Approx(4.9));
  CHECK(apart.at("errors").at("second").at("channels").at("position_north_m").at("rms").get<double>() ==
        doctest::Approx(5));
  CHECK(apart.at("first").at("name") == "old");
  CHECK(apart.at("second").at("name") == "new");
  CHECK(say("--names old " + a + " " + c).code == 1);
}

TEST_CASE("a span of flight time; a log that was cut off is read up to there, and that is told") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap", part = folder.path / "b.mcap.part";
  write_three(log, 1000, [](int i, VehicleState& first, VehicleState& second, VehicleState&) {
    second.position_m.north = i * 20 < 10'000 ? 1 : 3;
    first.position_m.east = std::sin(i);  // so that chunks cannot be compressed to nothing
  });
  const json whole = compared(log + " --from 12 --to 15");
  CHECK(whole.at("compared") == 151);
  CHECK(whole.at("difference").at("position_north_m").at("mean") == 3);
  CHECK(whole.at("errors").at("second").at("compared") == 151);
  CHECK(whole.at("first").at("fault").is_null());
  const std::string bytes = core::test::contents(log);
  core::test::store(part, bytes.substr(0, bytes.size() / 2));
  const json cut = compared(part);
  CHECK(cut.at("compared") > 100);
  CHECK(cut.at("compared") < 900);
  CHECK(cut.at("first").at("fault").is_string());
  CHECK(compared(part + " " + log + " nav").at("second").at("fault").is_null());
}

}  // namespace compare_choice_test
