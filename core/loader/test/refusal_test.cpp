// SPDX-License-Identifier: BSD-3-Clause
// Every kind of bad file, and the exact message to the user.
#include <doctest/doctest.h>
#include <elf.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "core/loader/shared_object.hpp"
#include "core/loader/store.hpp"
#include "workshop.hpp"

namespace refusal_test {

using namespace workshop;

namespace {

// A copy of the good plugin whose ELF header is changed.
template <class Change>
fs::path with_header(const std::string& name, const Change& change) {
  std::string bytes = read(plugin("good"));
  Elf64_Ehdr header;
  std::memcpy(&header, bytes.data(), sizeof header);
  change(header);
  std::memcpy(bytes.data(), &header, sizeof header);
  return write(name, bytes);
}

std::string host() {
  Elf64_Ehdr header;
  std::memcpy(&header, read(plugin("good")).data(), sizeof header);
  return header.e_machine == EM_X86_64 ? "x86_64" : header.e_machine == EM_AARCH64 ? "aarch64" : "another";
}

}  // namespace

TEST_CASE("a file that is missing, a folder, or not a shared object is rejected") {
  CHECK(refusal(folder() / "no_such.so") ==
        "loader.plugin_missing(no_such.so, " + (folder() / "no_such.so").string() + ")");
  CHECK(refusal(FULMAR_TEST_PLUGIN_DIR "/stub") == "loader.plugin_not_regular(stub, " FULMAR_TEST_PLUGIN_DIR
                                                   "/stub)");
  CHECK(refusal(write("text.so", "this is no code\n")) == "loader.file_fault(text.so, loader.elf_missing)");
  CHECK(refusal(write("empty.so", "")) == "loader.file_fault(empty.so, loader.elf_missing)");
  CHECK(refusal(write("stump.so", read(plugin("good")).substr(0, 10))) ==
        "loader.file_fault(stump.so, loader.elf_header_truncated)");
  CHECK(refusal(with_header("object.so", [](Elf64_Ehdr& h) { h.e_type = ET_REL; })) ==
        "loader.file_fault(object.so, loader.elf_not_shared)");
}

TEST_CASE("a truncated file is rejected before it is mapped") {
  const std::string whole = read(plugin("good"));
  CHECK(refusal(write("short.so", whole.substr(0, whole.size() - 1))) ==
        "loader.file_fault(short.so, loader.plugin_truncated(" + std::to_string(whole.size()) + ", " +
            std::to_string(whole.size() - 1) + "))");
  CHECK(refusal(write("header.so", whole.substr(0, 64))) ==
        "loader.file_fault(header.so, loader.program_headers_damaged)");
  CHECK(refusal(with_header("far.so", [](Elf64_Ehdr& h) { h.e_phoff = ~0ull; })) ==
        "loader.file_fault(far.so, loader.program_headers_damaged)");
}

TEST_CASE("a file for another machine is rejected") {
  CHECK(refusal(with_header("alien.so", [](Elf64_Ehdr& h) { h.e_machine = EM_S390; })) ==
        "loader.file_fault(alien.so, loader.machine_differs(s390, " + host() + "))");
  CHECK(refusal(with_header("odd.so", [](Elf64_Ehdr& h) { h.e_machine = 9999; })) ==
        "loader.file_fault(odd.so, loader.machine_differs(machine 9999, " + host() + "))");
  const Elf64_Half other = host() == "aarch64" ? EM_X86_64 : EM_AARCH64;
  CHECK(refusal(with_header("arm.so", [&](Elf64_Ehdr& h) { h.e_machine = other; })) ==
        std::string("loader.file_fault(arm.so, loader.machine_differs(") +
            (other == EM_AARCH64 ? "aarch64" : "x86_64") + ", " + host() + "))");
}

TEST_CASE("a shared object that is no plugin, or of another ABI, is rejected") {
  CHECK(refusal(plugin("no_entry")) == "loader.entry_symbol_missing(no_entry.so, fulmar_plugin_entry)");
  CHECK(refusal(plugin("wrong_abi")) == "loader.plugin_abi_differs(wrong_abi.so, 2.0, 1.2)");
  CHECK(refusal(plugin("newer_minor")) == "accepted");
}

TEST_CASE("a plugin with a missing dependency is rejected") {
  CHECK(refusal(plugin("missing_library")) ==
        "loader.required_library_missing(missing_library.so, libfulmar_test_stub.so)");
  CHECK(refusal(plugin("missing_symbol")) ==
        "loader.required_symbol_missing(missing_symbol.so, fulmar_test_nowhere)");
}

TEST_CASE("a text of the system's loader becomes a sentence") {
  using fulmar::core::load_fault;
  const std::pair<const char*, const char*> cases[] = {
      {"libfoo.so.1: cannot open shared object file: No such file or directory",
       "loader.required_library_missing(x.so, libfoo.so.1)"},
      {"/lib/libm.so.6: version `GLIBC_2.99' not found (required by /store/ab.so)",
       "loader.required_version_missing(x.so, GLIBC_2.99)"},
      {"/store/ab.so: undefined symbol: exp10, version LIB_1", "loader.required_symbol_missing(x.so, exp10)"},
      {"/store/ab.so: ELF load command alignment not page-aligned",
       "loader.plugin_not_loadable(x.so, ELF load command alignment not page-aligned)"},
  };
  for (const auto& [text, reported] : cases) CHECK(load_fault("x.so", text) == reported);
  CHECK(load_fault("x.so", nullptr) == "loader.plugin_not_loadable(x.so, no reason given)");
}

TEST_CASE("tables that the host does not understand are rejected by name") {
  CHECK(refusal(plugin("unknown_port")) ==
        "unknown_port.so: loader.port_kind_unknown(port 'place' of component 'Point', 99)");
  CHECK(refusal(plugin("misplaced_port")) ==
        "misplaced_port.so: loader.port_is_input(port 'place' of component 'Point')");
  CHECK(refusal(plugin("unknown_param")) ==
        "unknown_param.so: loader.port_kind_unknown(parameter 'gain' of component 'Point', 98)");
  CHECK(refusal(plugin("unknown_field")) ==
        "unknown_field.so: loader.port_kind_unknown(type 'Point': field 'x_m', 97)");
}

TEST_CASE("tables that contradict themselves are rejected by name") {
  CHECK(refusal(plugin("overlap")) == "overlap.so: type 'Point': loader.fields_overlap(x_m, y_m)");
  CHECK(refusal(plugin("misaligned")) ==
        "misaligned.so: loader.field_not_aligned(type 'Point': field 'y_m')");
  CHECK(refusal(plugin("beyond")) == "beyond.so: type 'Point': loader.field_outside_struct(y_m)");
  CHECK(refusal(plugin("same_names")) == "same_names.so: loader.field_repeated(type 'Point', x_m)");
  CHECK(refusal(plugin("bad_name")) == "bad_name.so: type 'Point': loader.field_name_invalid(y m)");
  CHECK(refusal(plugin("bad_default")) ==
        "bad_default.so: loader.default_out_of_range(parameter 'gain' of component 'Point', 3, 0, 2)");
  CHECK(refusal(plugin("bad_stride")) ==
        "bad_stride.so: loader.table_stride_invalid(the outputs of component 'Point', 8, 32)");
  CHECK(refusal(plugin("wild_text")) ==
        "wild_text.so: loader.text_outside_memory(component 'Point': the description)");
  CHECK(refusal(plugin("no_step")) == "no_step.so: loader.function_missing(component 'Point', step)");
  CHECK(refusal(plugin("no_read")) == "no_read.so: loader.function_missing(component 'Point', read)");
}

TEST_CASE("files that would share static data are not loaded together") {
  if (!fs::exists(plugin("resident_unique"))) return;  // clang makes no such symbols
  const auto first = fulmar::core::Library::open(plugin("resident_unique"));
  const std::string second = refusal(plugin("resident_unique_too"));
  CHECK_MESSAGE(second.starts_with("loader.unique_symbol_shared(resident_unique_too.so, "), second);
  CHECK_MESSAGE(second.ends_with(", resident_unique.so)"), second);
  CHECK(refusal(plugin("resident_unique")) == "accepted");
  CHECK(refusal(plugin("unique_alone")) == "accepted");
}

TEST_CASE("the last output of a plugin that cannot be loaded is in the error, without control characters") {
  CHECK(refusal(plugin("words_throws")) ==
        "loader.plugin_crashed(words_throws.so, loaded, 6, : what():  the licence server is not reached)");
  CHECK(refusal(plugin("words_exits")) ==
        "loader.plugin_ended_process(words_exits.so, loaded, 1, : the runtime does not come first)");
  const std::string aborted = refusal(plugin("words_aborts"));
  CHECK(aborted.starts_with(
      "loader.plugin_crashed(words_aborts.so, loaded, 6, : ?[31mSUMMARY: out of licences?)"));
  CHECK_MESSAGE(aborted.find("SUMMARY: out of licences") != std::string::npos, aborted);
  CHECK(aborted.find_first_of("\x1b\x07\n") == std::string::npos);
}

TEST_CASE("a plugin's code at loading affects only a child") {
  CHECK(refusal(plugin("crash")) == "loader.plugin_crashed(crash.so, loaded, 11, )");
  CHECK(refusal(plugin("crash_unload")) == "loader.plugin_crashed(crash_unload.so, unloaded, 6, )");
  CHECK(refusal(plugin("exits")) == "loader.plugin_ended_process(exits.so, loaded, 0, )");
  const Environment limit("FULMAR_PROBE_SECONDS", "0.4");
  CHECK(refusal(plugin("hang")) == "loader.probe_timed_out(hang.so, loading, 1.6 s)");
  const std::string busy = refusal(plugin("busy"));  // on a busy machine the wall-clock limit may come first
  CHECK((busy == "loader.probe_timed_out(busy.so, loading, 0.4 s of the CPU)" ||
         busy == "loader.probe_timed_out(busy.so, loading, 1.6 s)"));
}

TEST_CASE("every process that a plugin starts in its probe ends with the probe") {
  const fs::path file = folder() / "started";
  const Environment named("SLY_FILE", file.string()), limit("FULMAR_PROBE_SECONDS", "1");
  struct Deed {
    const char *then, *reported;
  };
  for (const Deed& deed :
       {Deed{"hang", "loader.probe_timed_out(sly_setsid.so, loading, 4 s)"},
        Deed{"crash", "loader.plugin_crashed(sly_setsid.so, loaded, 11, )"},
        Deed{"exit", "loader.plugin_ended_process(sly_setsid.so, loaded, 0, )"}, Deed{"", "accepted"}}) {
    CAPTURE(deed.then);
    fs::remove(file);
    const Environment what("SLY_THEN", deed.then);
    CHECK(refusal(plugin("sly_setsid")) == deed.reported);
    pid_t started = 0;
    std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(&started), sizeof started);
    REQUIRE(started > 0);
    CHECK(::kill(started, 0) != 0);
  }
}

TEST_CASE("a good plugin on a busy machine gets the time that it needs") {
  const Environment limit("FULMAR_PROBE_SECONDS", "0.8");
  CHECK(refusal(plugin("slow")) == "accepted");  // 0.9 s of wall time, almost no CPU time
}

TEST_CASE("a process with few free descriptors can probe a plugin") {
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  const rlimit few{64, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &few) == 0);
  const std::string printed = refusal(plugin("good"));
  ::setrlimit(RLIMIT_NOFILE, &before);
  CHECK(printed == "accepted");
}

TEST_CASE("a plugin that changes the floating-point mode is rejected") {
  CHECK(refusal(plugin("rounding")) == "loader.plugin_changes_float_mode(rounding.so)");
  if (!fs::exists(plugin("fast_math"))) {
    MESSAGE("this compiler has no crtfastmath.o: denormals not tried");
    return;
  }
  CHECK(refusal(plugin("fast_math")) == "loader.plugin_changes_float_mode(fast_math.so)");
}

TEST_CASE("a rejected plugin leaves no copy in the store") {
  refusal(plugin("crash"));
  CHECK_FALSE(fs::exists(folder() / "store" / (fulmar::core::sha256_file(plugin("crash")) + ".so")));
}

TEST_CASE("without the probing program nothing is loaded") {
  const Environment missing("FULMAR_PROBE", "/nowhere/fulmar-probe");
  CHECK(refusal(plugin("overlap")) ==
        "loader.program_not_started(/nowhere/fulmar-probe, No such file or directory)");
}

TEST_CASE("a store that other users can write to is rejected") {
  const fs::path open = folder() / "open store";
  fs::create_directory(open);
  ::chmod(open.c_str(), 0777);
  const Environment store("FULMAR_STORE", open.string());
  CHECK(refusal(plugin("good_open")) == "loader.store_not_private(" + open.string() + ")");
}

TEST_CASE("a copy in the store that was altered is replaced") {
  const std::string text = "the true content";
  const auto keep = [&] {
    return fulmar::core::keep_copy(std::as_bytes(std::span(text)),
                                   fulmar::core::sha256_hex(text.data(), text.size()));
  };
  folder();
  const fs::path copy = keep();
  fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
  std::ofstream(copy) << "the bent content";  // same length as the original
  CHECK(keep() == copy);
  CHECK(read(copy) == text);
}

TEST_CASE("a flown file is found again by its SHA-256, libraries and scripts alike, and no other is") {
  folder();
  const std::string law = "print(1)", gone = "never kept";
  const std::string law_sha = fulmar::core::sha256_hex(law.data(), law.size()),
                    gone_sha = fulmar::core::sha256_hex(gone.data(), gone.size());
  const fs::path copy = fulmar::core::keep_copy(std::as_bytes(std::span(law)), law_sha, ".py");
  CHECK(copy.extension() == ".py");
  CHECK(fulmar::core::find_in_store(law_sha) == copy);
  CHECK(fulmar::core::version_that_flew("law.py", "1.0.0", law_sha) == copy);
  CHECK_FALSE(fulmar::core::find_in_store(gone_sha));
  CHECK_FALSE(fulmar::core::find_in_store("../" + law_sha));
  fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
  std::ofstream(copy) << "print(2)";
  CHECK_FALSE(fulmar::core::find_in_store(law_sha));  // altered since
}

TEST_CASE("a missing version is named") {
  const std::string sha(64, 'e');
  std::string printed;
  try {
    fulmar::core::version_that_flew("my_law.so", "1.4.0", sha);
  } catch (const fulmar::core::Error& fault) {
    printed = fault.what();
  }
  CHECK(printed ==
        "loader.stored_plugin_missing(my_law.so, 1.4.0, " + sha + ", " + (folder() / "store").string() + ")");
}

TEST_CASE("the store keeps the 128 most recently used copies") {
  const Environment store("FULMAR_STORE", (folder() / "full store").string());
  std::vector<std::string> kept;
  const auto keep = [&](int i) {
    const std::string text = "copy " + std::to_string(i);
    kept.push_back(fulmar::core::sha256_hex(text.data(), text.size()));
    const fs::path copy =
        fulmar::core::keep_copy(std::as_bytes(std::span(text)), kept.back(), i % 2 == 0 ? ".so" : ".py");
    // so that the order does not depend on the clock's resolution
    fs::last_write_time(copy, fs::file_time_type::clock::now() - std::chrono::hours(200 - i));
  };
  for (int i = 0; i < 128; ++i) keep(i);
  CHECK(fulmar::core::find_in_store(kept[0]).has_value());  // and is thereby the most recent
  keep(128);
  CHECK(fulmar::core::find_in_store(kept[0]).has_value());
  CHECK_FALSE(fulmar::core::find_in_store(kept[1]).has_value());
  CHECK(fulmar::core::find_in_store(kept[2]).has_value());
}

TEST_CASE("the store is private and its copies are read-only") {
  const std::string text = "a copy";
  folder();
  const fs::path copy = fulmar::core::keep_copy(std::as_bytes(std::span(text)),
                                                fulmar::core::sha256_hex(text.data(), text.size()));
  struct stat info {};
  REQUIRE(::stat(copy.c_str(), &info) == 0);
  CHECK((info.st_mode & 0777) == 0400);
  REQUIRE(::stat(copy.parent_path().c_str(), &info) == 0);
  CHECK((info.st_mode & 0777) == 0700);
}

TEST_CASE("SHA-256 gives the digest of FIPS 180-2") {
  CHECK(fulmar::core::sha256_hex("abc", 3) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace refusal_test
