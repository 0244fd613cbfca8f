// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_new/new_source.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

bool has_header(const Type& type, const fs::path& include) {
  std::ifstream in(include / "fulmar" / "msg" / (snake_case(type.name) + ".hpp"));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str().find("struct " + type.name + " {") != std::string::npos;
}

/// Include line of one of the SDK's headers.
std::string include_line(const std::string& header) {
  return "#include <" + ("fulmar/" + header) + ".hpp>\n";
}

/// Writes the parts of one component. The prefix "messages::" marks types that the header itself declares.
class SourceWriter {
 public:
  SourceWriter(const Contract& contract, std::string name, std::string type, const fs::path& include)
      : c_(contract), name_(std::move(name)), type_(std::move(type)) {
    for (const ContractInput& input : c_.inputs) use(input.type, include);
    for (const ContractOutput& output : c_.outputs) use(output.type, include);
  }

  std::string header() const {
    std::string text = "// SPDX-License-Identifier: BSD-3-Clause\n";
    text += intent();
    text += "#pragma once\n";
    for (const std::string& header : headers_) text += include_line("msg/" + header);
    text +=
        include_line("plugin") + (c_.vehicle() ? "#include <cmath>\n" : "") + "\nusing namespace fulmar;\n\n";
    if (!own_.empty())
      text += std::string("namespace messages {") +
              (c_.roles.empty() ? "  // a number's name ends in its unit; absence is a flag\n\n"
                                : "  // as the mission's own plugins have them\n\n") +
              own_ + "}  // namespace messages\n\n";
    text += "struct " + type_ + " {" + fills() + "\n";
    text += "  static constexpr const char* doc = \"" + pascal_case(name_) + ".\";\n" + ports() +
            (c_.vehicle()       ? vehicle_body()
             : c_.roles.empty() ? body_beside()
                                : body());
    return text + "};\n";
  }

  std::string test() const {
    std::string text =
        "// SPDX-License-Identifier: BSD-3-Clause\n#include <doctest/doctest.h>\n\n"
        "#define FULMAR_COUNT_ALLOCATIONS\n" +
        include_line("testing") + "\n#include \"" + name_ + ".hpp\"\n\n";
    return text + (c_.vehicle() ? vehicle_test() : contract_test());
  }

 private:
  void use(const TypePtr& type, const fs::path& include) {
    if (!type || !seen_.insert(type->name).second) return;
    if (has_header(*type, include)) {
      headers_.insert(snake_case(type->name));
    } else {
      own_types_.insert(type->name);
      std::istringstream structs(message_source(*type));  // a nested struct may exist already
      std::string part, line;
      while (std::getline(structs, line)) {
        part += line + "\n";
        if (!line.empty()) continue;
        if (own_.find(part) == std::string::npos) own_ += part;
        part.clear();
      }
    }
  }
  std::string word(const Type& type) const {
    return (own_types_.count(type.name) ? "messages::" : "") + type.name;
  }

  static std::string input_kind(const ContractInput& input) {
    if (input.kind == FULMAR_IN_QUEUE) return "Queue";
    if (input.kind == FULMAR_IN_REQUEST) return "Request";
    return input.optional ? "Optional" : "In";
  }
  std::string intent() const {
    if (c_.vehicle())
      return "// A vehicle that keeps the time; its outputs are constant until you fill them.\n";
    if (c_.roles.empty()) return "// Fills no role. As generated it publishes nothing.\n";
    std::string use;
    for (const ContractRole& role : c_.roles) use += (use.empty() ? "" : " and ") + role.shipped_use;
    return std::string("// Fills the role") + (c_.roles.size() > 1 ? "s " : " ") + c_.role_words() +
           ". As generated it passes on what\n// " + use +
           (c_.roles.size() > 1 ? " compute.\n" : " computes.\n");
  }
  std::string fills() const {
    std::string text;
    for (const ContractRole& role : c_.roles)
      text += (text.empty() ? c_.roles.size() > 1 ? "  // fills the roles `" : "  // fills the role `"
                            : "` and `") +
              role.name;
    return text.empty() ? "" : text + "`";
  }

  bool passes_on(const ContractOutput& output) const {
    return !c_.vehicle() && !c_.roles.empty() && output.type && !output.optional;
  }
  static bool queue(const ContractOutput& output) { return output.kind == FULMAR_OUT_QUEUE; }

  std::string output_type(const ContractOutput& output) const {
    const std::string type = word(*output.type);
    if (queue(output)) return "OutQueue<" + type + ", " + std::to_string(output.capacity) + ">";
    return output.kind == FULMAR_OUT_EVENT ? "Out<" + type + ">" : type;
  }

  std::string ports() const {
    std::string text = "  struct Inputs {\n", passed;
    for (const ContractInput& input : c_.inputs)
      text += "    " + input_kind(input) + "<" + word(*input.type) + "> " + input.name + ";\n";
    for (const ContractOutput& output : c_.outputs) {
      const char* kind = queue(output) ? "Queue" : output.kind == FULMAR_OUT_EVENT ? "Optional" : "In";
      if (passes_on(output))
        passed +=
            std::string("    ") + kind + "<" + word(*output.type) + "> reference_" + output.name + ";\n";
    }
    if (!passed.empty())
      text +=
          "    // Outputs of the shipped component, as a reference. Remove them here, in the test and in\n"
          "    // mission.yaml when your law replaces them.\n" +
          passed;
    text += "  };\n  struct Outputs {\n";
    for (const ContractOutput& output : c_.outputs)
      if (output.type && (!output.optional || c_.vehicle()))
        text += "    " + output_type(output) + " " + output.name + ";\n";
    if (!c_.vehicle()) return text + "  };\n  struct Params {};\n\n";
    return text +
           "  };\n  struct Params {\n    Param rate{400, \"Hz\", 10, 2000, \"rate of the loop; the rate of "
           "the mission\", "
           "setup};\n  };\n\n";
  }

  std::string body() const {
    std::string text =
        "  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {\n    // Your law goes "
        "here.\n";
    for (const ContractOutput& output : c_.outputs) {
      if (!passes_on(output)) continue;
      const std::string from = "in.reference_" + output.name;
      if (queue(output))
        text += "    for (const auto& sample : " + from + ") out." + output.name +
                ".push(sample.value, sample.valid_at_ns);\n";
      else if (output.kind == FULMAR_OUT_EVENT)
        text += "    if (" + from + " && " + from + ".fresh()) out." + output.name + ".publish(*" + from +
                ", " + from + ".valid_at_ns());\n";
      else
        text += "    out." + output.name + " = *" + from + ";\n";
    }
    return text + "    return Status::ok;\n  }\n";
  }

  /// Without a law yet the component publishes nothing.
  std::string body_beside() const {
    std::string text =
        "  Status step(const Tick& tick, const Inputs& in, const Params&, Outputs& out) {\n    // Your law "
        "goes "
        "here.\n";
    for (const ContractInput& input : c_.inputs)
      if (input.kind == FULMAR_IN_QUEUE)
        text += "    //   for (const auto& sample : in." + input.name +
                ") ...  // sample.value, sample.valid_at_ns, sample.valid_at_s()\n";
      else
        text += "    //   " + std::string(input.optional ? "if (in." + input.name + ") " : "") + "in." +
                input.name + "->..." + "  // in." + input.name + ".fresh(), in." + input.name +
                ".valid_at_s()\n";
    for (const ContractOutput& output : c_.outputs)
      text +=
          "    //   " + word(*output.type) + " " + output.name + ";  out." + output.name +
          (queue(output) ? ".push(" + output.name + ", tick.now_ns);\n" : ".publish(" + output.name + ");\n");
    return text + "    (void)tick, (void)in, (void)out;\n    return Status::ok;\n  }\n";
  }

  std::string vehicle_body() const {
    std::string text =
        "  void configure(const Params& p) {\n    period_ns_ = std::llround(1e9 / p.rate);\n    now_ns_ = "
        "-period_ns_;\n  }\n\n"
        "  Status read(Tick& tick, const Params&, Outputs& out) {\n    tick.now_ns = now_ns_ += "
        "period_ns_;\n";
    for (const ContractOutput& output : c_.outputs)
      if (output.type && !queue(output))
        text += "    out." + output.name + (output.kind == FULMAR_OUT_EVENT ? ".publish({});\n" : " = {};\n");
    text += "    return Status::ok;\n  }\n\n  Status write(const Tick&, const Inputs& in, const Params&) {\n";
    bool asked = false;
    for (const ContractInput& input : c_.inputs)
      if (input.kind == FULMAR_IN_REQUEST) {
        text += "    for (auto request : in." + input.name + ") request.accept();\n";
        asked = true;
      }
    if (!asked) text += "    (void)in;\n";
    return text +
           "    return Status::ok;\n  }\n\n private:\n  std::int64_t period_ns_ = 2500000, now_ns_ = 0;\n";
  }

  /// Test of the contract alone, which any law passes.
  std::string contract_test() const {
    std::string set;
    for (const ContractInput& input : c_.inputs)
      if (input.kind != FULMAR_IN_REQUEST)
        set += std::string("    bench.") + (input.kind == FULMAR_IN_QUEUE ? "push" : "set") + "(bench.in." +
               input.name + ", " + word(*input.type) + "{});\n";
    for (const ContractOutput& output : c_.outputs)
      if (passes_on(output))
        set += std::string("    bench.") + (queue(output) ? "push" : "set") + "(bench.in.reference_" +
               output.name + ", " + word(*output.type) + "{});  // goes with the reference\n";
    return "TEST_CASE(\"what it says is finite and in range, and it takes no memory\") {\n  Bench<" + type_ +
           "> bench;\n  for (int i = 0; i < 100; ++i) {\n" + set +
           "    REQUIRE(allocations([&] { REQUIRE(bench.step(0.01) == Status::ok); }) == 0);\n"
           "    REQUIRE(bench.validation_error() == \"\");\n  }\n}\n";
  }

  std::string vehicle_test() const {
    return "TEST_CASE(\"time begins at 0 and goes by one period\") {\n  Bench<" + type_ +
           "> bench;\n  bench.params.rate.value = 100;\n  REQUIRE(bench.read() == Status::ok);\n  "
           "CHECK(bench.tick.now_ns == 0);\n"
           "  REQUIRE(bench.read() == Status::ok);\n  CHECK(bench.tick.now_ns == 10000000);\n  "
           "CHECK(bench.write() == Status::ok);\n}\n";
  }

  const Contract& c_;
  std::string name_, type_, own_;
  std::set<std::string> headers_, own_types_, seen_;
};

}  // namespace

std::string pascal_case(const std::string& name) {
  std::string text;
  bool up = true;
  for (const char c : name) {
    if (c != '_') text += up ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    up = c == '_';
  }
  return text;
}

std::string snake_case(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool up = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (up && !text.empty()) text += '_';
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

NewSource write_source(const Contract& contract, const std::string& name, const std::string& type,
                       const fs::path& include) {
  const SourceWriter source(contract, name, type, include);
  return {source.header(), source.test()};
}

}  // namespace fulmar::core
