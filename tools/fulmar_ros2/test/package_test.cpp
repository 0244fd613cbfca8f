// SPDX-License-Identifier: BSD-3-Clause
// The package for ROS 2, read back: parsed texts have the type hashes of the transmitted messages, names are
// valid for rosidl, and files of other packages are not touched.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "core/loader/library.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/run/control.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_ros2/interface_package.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace package_test {

namespace {

namespace fs = std::filesystem;
using fulmar::core::Library;
using fulmar::ros2::Collector;
using fulmar::ros2::Package;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar_ros2_test_" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

Package package_of(const std::vector<std::string>& plugins) {
  Collector collector;
  for (const std::string& name : plugins)
    collector.add(Library::open(fs::path(FULMAR_PLUGIN_DIR) / (name + ".so"))->info());
  return collector.package();
}

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The .msg of a message with those of all that it holds, as one schema.
std::string schema(const Package& p, const std::string& name, std::set<std::string>& seen) {
  const std::string& own = p.files.at("msg/" + name + ".msg");
  std::string text = own;
  static const std::regex nested("fulmar_msgs/([A-Za-z0-9]+)");
  for (std::sregex_iterator it(own.begin(), own.end(), nested), end; it != end; ++it) {
    const std::string inner = (*it)[1];
    if (seen.insert(inner).second) text += "\n===\nMSG: fulmar_msgs/" + inner + "\n" + schema(p, inner, seen);
  }
  return text;
}

int run(const std::string& arguments, std::string* said = nullptr) {
  const std::string line = "timeout 60 " FULMAR_BIN_DIR "/fulmar-ros2 " + arguments + " 2>&1 </dev/null";
  std::FILE* pipe = ::popen(line.c_str(), "r");
  std::string out;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) out += static_cast<char>(c);
  const int status = ::pclose(pipe);
  if (said) *said = out;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("each text, parsed again, has the hash of its message on the wire") {
  const Package p = package_of({"path", "ros_bridge"});
  CHECK(p.hashes.count("fulmar_msgs/msg/Plan") == 1);
  CHECK(p.hashes.count("fulmar_msgs/msg/Vec3Ned") == 1);
  for (const auto& message : p.hashes) {
    const std::string &name = message.first, &hash = message.second;
    CAPTURE(name);
    std::set<std::string> seen;
    const auto parsed =
        fulmar::core::parse_ros_definition(name, schema(p, name.substr(name.rfind('/') + 1), seen));
    CHECK(fulmar::core::ros_type_hash(*parsed) == hash);
  }
}

TEST_CASE("names and lines are those that rosidl takes, and every message that is used is there") {
  const Package p = package_of({"path", "ros_bridge"});
  const std::regex field(
      "(bool|u?int(8|16|32|64)|float(32|64)|string|[a-z_]+/[A-Z][A-Za-z0-9]*)(\\[(<=)?[0-9]*\\])? "
      "[a-z][a-z0-9_]*( +#.*)?");
  const std::regex constant("uint8 [A-Z][A-Z0-9_]*=[0-9]+");
  for (const auto& entry : p.files) {
    const std::string &file = entry.first, &text = entry.second;
    if (!file.starts_with("msg/") && !file.starts_with("srv/")) continue;
    CAPTURE(file);
    CHECK(std::regex_match(file, std::regex("(msg|srv)/[A-Z][A-Za-z0-9]*\\.(msg|srv)")));
    CHECK(p.files.at("CMakeLists.txt").find("\"" + file + "\"") != std::string::npos);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      CAPTURE(line);
      const bool good = line.empty() || line == "---" || line[0] == '#' || std::regex_match(line, constant) ||
                        std::regex_match(line, field);
      CHECK(good);
      const std::size_t ours = line.rfind("fulmar_msgs/", 0);
      if (ours == 0)
        CHECK(p.files.count("msg/" + line.substr(12, line.find_first_of(" [", 12) - 12) + ".msg") == 1);
    }
  }
}

TEST_CASE(
    "a package of a mission has every message that a log of it holds and ROS has not, with the text and the "
    "hash of the log") {
  const Folder folder;
  fs::create_directories(folder.path);
  const fs::path log = folder.path / "flight.mcap", package = folder.path / "fulmar_msgs";
  const std::string mission = FULMAR_SOURCE_DIR "/configs/missions/two_schemes.yaml";
  const std::string fly = FULMAR_BIN_DIR "/fulmar run " + mission + " --duration 5 --live off --log " +
                          log.string() + " >/dev/null 2>&1";
  REQUIRE(std::system(fly.c_str()) != -1);
  REQUIRE(run("interface-package " + package.string() + " --mission " + mission) == 0);
  const std::string readme = read(package / "README.md"), cmake = read(package / "CMakeLists.txt");
  const fulmar::core::WholeLog file = fulmar::core::read_mcap(log);
  std::map<std::string, std::string> texts;  // by name
  std::set<std::string> of_ros;
  for (const auto& entry : file.channels) {
    const fulmar::core::McapFile::Channel& channel = entry.second;
    const fulmar::core::McapFile::Schema& schema = file.schemas.at(channel.schema);
    CAPTURE(channel.topic);
    CAPTURE(schema.name);
    CHECK(texts.emplace(schema.name, schema.text).first->second ==
          schema.text);  // ROS identifies messages by name alone
    if (!schema.name.starts_with("fulmar_msgs/msg/")) {
      of_ros.insert(schema.name.substr(0, schema.name.find('/')));
      continue;
    }
    const std::string name = schema.name.substr(16);
    CHECK(read(package / "msg" / (name + ".msg")) ==
          schema.text.substr(0, schema.text.find(std::string(80, '='))));
    CHECK(cmake.find("\"msg/" + name + ".msg\"") != std::string::npos);
    for (const auto& pair : channel.metadata)
      if (pair.first == "topic_type_hash")
        CHECK(readme.find("| " + schema.name + " | `" + pair.second + "` |") != std::string::npos);
  }
  CHECK(of_ros == std::set<std::string>{"geometry_msgs", "nav_msgs", "rcl_interfaces", "sensor_msgs",
                                        "tf2_msgs", "visualization_msgs"});
  for (const char* name : {"Event", "Ticks", "Plan", "ControlSlcOuterProbes"})
    CHECK(texts.count("fulmar_msgs/msg/" + std::string(name)) == 1);
  // what this flight had no occasion for
  CHECK(readme.find(fulmar::core::ros_type_hash(*fulmar::core::host_type<fulmar::core::CommandNote>())) !=
        std::string::npos);
  CHECK(read(package / "msg/Command.msg") ==
        "uint8 PARAMETER=0\nuint8 PHASE=1\nuint8 SWAP=2\nuint8 RESET=3\nuint8 REQUEST=4\nuint8 "
        "IMPORT=5\nuint8 kind\n"
        "string component\nstring name\nfloat64[3] number\nint64 integer\nstring text\nstring "
        "version\nstring sha256\n");
  CHECK(read(package / "msg/ControlTecsOuterProbes.msg").find("float64 underspeed_ratio\n") !=
        std::string::npos);
}

TEST_CASE(
    "messages of ROS are not written again, and a request is a service that answers with a verdict and a "
    "reason") {
  const Package p = package_of({"path", "ros_bridge"});
  CHECK(p.files.count("msg/PoseStamped.msg") == 0);
  CHECK(p.files.count("msg/RosPoseStamped.msg") == 0);
  const std::string& srv = p.files.at("srv/PlanEdit.srv");
  CHECK(srv.find("fulmar_msgs/Waypoint waypoint") != std::string::npos);
  CHECK(srv.find("---\nbool accepted\nstring reason") != std::string::npos);
  CHECK(p.files.at("package.xml").find("<name>fulmar_msgs</name>") != std::string::npos);
}

TEST_CASE("two different messages of one name are refused") {
  const auto type = [](fulmar_kind kind) {
    auto t = std::make_shared<fulmar::core::Type>();
    t->name = "Thing";
    t->size = 8;
    t->align = 8;
    fulmar::core::Field f;
    f.name = "x_m";
    f.kind = kind;
    f.stride = 8;
    t->fields.push_back(f);
    return t;
  };
  const auto plugin = [&](const std::string& file, fulmar_kind kind, const std::string& field = "x_m") {
    fulmar::core::PluginInfo info;
    info.file = file;
    info.components.resize(1);
    fulmar::core::Port port;
    port.type = type(kind);
    std::const_pointer_cast<fulmar::core::Type>(port.type)->fields[0].name = field;
    info.components[0].outputs.push_back(port);
    return info;
  };
  Collector collector;
  collector.add(plugin("a.so", FULMAR_F64));
  collector.add(plugin("a.so", FULMAR_F64));
  CHECK_THROWS_WITH(collector.add(plugin("b.so", FULMAR_I64)),
                    "ros2.message_name_ambiguous(Thing, a.so, b.so)");
  Collector other;
  CHECK_THROWS_WITH(other.add(plugin("a.so", FULMAR_F64, "X_m")), "ros2.field_name_invalid(Thing, X_m)");
}

TEST_CASE("a folder of somebody else is left alone, one of ours is brought up to date") {
  const Folder folder;
  Package p;
  p.files["msg/Old.msg"] = "bool a\n";
  p.files["package.xml"] = "<x/>";
  write_package(p, folder.path);
  CHECK(read(folder.path / "msg/Old.msg") == "bool a\n");
  p.files.erase("msg/Old.msg");
  p.files["msg/New.msg"] = "bool b\n";
  std::ofstream(folder.path / "notes.txt") << "mine";
  write_package(p, folder.path);
  CHECK_FALSE(fs::exists(folder.path / "msg/Old.msg"));
  CHECK(read(folder.path / "msg/New.msg") == "bool b\n");
  CHECK(read(folder.path / "notes.txt") == "mine");
  fs::remove(folder.path / "package.fulmar");
  CHECK_THROWS(write_package(p, folder.path));
  CHECK(read(folder.path / "msg/New.msg") == "bool b\n");
}

TEST_CASE("the program writes a package, refuses another's folder with 1, and tells wrong usage with 2") {
  const Folder folder;
  std::string said;
  const std::string plugins = " " FULMAR_PLUGIN_DIR "/path.so";
  CHECK(run("interface-package " + folder.path.string() + plugins, &said) == 0);
  CHECK(said.find("services") != std::string::npos);
  CHECK(fs::exists(folder.path / "msg/VehicleState.msg"));
  CHECK(run("interface-package " + folder.path.string() + plugins) == 0);
  CHECK(run("interface-package " + (folder.path / "msg").string() + plugins, &said) == 1);
  CHECK(said.find("ros2.folder_in_use(" + (folder.path / "msg").string()) != std::string::npos);
  CHECK(run("interface-package " + folder.path.string() + " no_such_plugin") == 1);
  CHECK(run("") == 2);
  CHECK(run("--help") == 0);
}

}  // namespace package_test
