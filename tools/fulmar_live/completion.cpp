// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/completion.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/parameters.hpp"
#include "tools/fulmar_live/ports.hpp"
#include "tools/fulmar_live/session.hpp"
#include "tools/fulmar_log/log_field.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

// ---- scripts

/// Kinds of the words after a command; the last `repeat` of them repeat.
struct Places {
  const char* kinds;
  int repeat;
};
const std::map<std::string, Places> places{
    {"run", {"mission", 0}},          {"check", {"mission", 0}},
    {"graph", {"mission", 0}},        {"inspect", {"plugin", 0}},
    {"replay", {"log", 0}},           {"report", {"log", 1}},
    {"compare", {"mission", 0}},      {"log info", {"log", 0}},
    {"log recover", {"log", 0}},      {"log export", {"log", 0}},
    {"log diff", {"log log", 0}},     {"log compare", {"log", 0}},
    {"response", {"log", 0}},         {"echo", {"port", 1}},
    {"plot", {"drawn", 1}},           {"param list", {"param", 0}},
    {"param get", {"param", 1}},      {"param set", {"param none", 2}},
    {"param save", {"component", 0}}, {"call", {"request none", 1}},
    {"phase", {"phase", 0}},          {"swap", {"component plugin", 0}},
    {"speed", {"speed", 0}},          {"completion", {"shell", 0}},
    {"aero trim", {"mission", 0}},    {"aero linearize", {"mission", 0}},
    {"aero modes", {"mission", 0}},   {"aero check", {"mission", 0}},
    {"aero tune", {"mission", 0}},    {"aero vlm", {"mission", 0}},
    {"aero fly", {"mission", 0}},     {"aero see", {"mission", 0}},
    {"aero import", {"file", 1}},     {"import rosplane", {"file", 0}}};

/// Of options that take a value: a kind as above.
const std::map<std::string, std::string> option_kinds{
    {"--io", "io"},           {"--format", "format"},    {"--speed", "speed"},
    {"--log", "file"},        {"--drivers-from", "log"}, {"--resume", "log"},
    {"--mission", "mission"}, {"--with", "file"},        {"--out", "file"},
    {"--over", "drawn"},      {"--panel", "drawn"}};

/// Output of a program of this installation that lists its commands. Throws Error.
std::string rows_of(const char* name) {
  const std::string program = own_program(name).string();
  if (program.empty()) throw Error(remote_messages::program_missing(name));
  std::string quoted = "'";
  for (const char c : program) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  std::FILE* pipe = ::popen((quoted + "' --rows").c_str(), "r");
  if (pipe == nullptr) throw Error(remote_messages::program_not_startable(program, std::strerror(errno)));
  std::string text;
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  if (::pclose(pipe) != 0) throw Error(remote_messages::subcommands_not_listed(program));
  return text;
}

/// Programs that a build may leave out; their commands are completed when they exist.
struct OptionalProgram {
  const char *name, *word;
};
constexpr OptionalProgram optional_programs[]{{"fulmar-aero", "aero"}, {"fulmar-import", "import"}};

void add_rows(const char* program, const std::string& word, const std::string& more_words,
              std::string& text) {
  const bool is_host = program == std::string_view("fulmar");
  std::istringstream rows(rows_of(program));
  std::string command, options, valued, subcommands;
  while (std::getline(rows, command, '\t') && std::getline(rows, options, '\t') &&
         std::getline(rows, valued, '\t') && std::getline(rows, subcommands)) {
    if (!word.empty())  // the program does not know the word that starts it
      command = word + (command.empty() ? "" : " " + command);
    else if (command.empty() && !is_host)
      continue;  // only the host lists all commands
    if (command.empty()) subcommands += more_words;
    const auto place = places.find(command);
    const bool placed = place != places.end();
    text += "    '" + command + "') options='" + options + "' valued='" + valued + " ' subcommands='" +
            subcommands + "' kinds='" + (placed ? place->second.kinds : "") +
            "' repeat=" + std::to_string(placed ? place->second.repeat : 0) + " ;;\n";
  }
}

/// The same in both shells: the lines of a `case` by command.
std::string table() {
  std::string text, words;
  for (const OptionalProgram& one : optional_programs)
    if (!own_program(one.name).empty()) words += std::string(" ") + one.word;
  for (const char* program :
       {"fulmar", "fulmar-inspect", "fulmar-log", "fulmar-new", "fulmar-live", "fulmar-replay"})
    add_rows(program, "", words, text);
  for (const OptionalProgram& one : optional_programs)
    if (!own_program(one.name).empty()) add_rows(one.name, one.word, "", text);
  return text;
}

std::string option_table() {
  std::string text;
  for (const auto& [option, kind] : option_kinds) text += "    " + option + ") kind=" + kind + " ;;\n";
  return text;
}

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
  return text;
}

// Words are taken from the line itself: bash splits HOST:PORT.
constexpr const char* bash_script = R"bash(# Completion of fulmar in bash: source <(fulmar completion bash)
_fulmar_command() {  # sets options, valued, subcommands, kinds, repeat of a command
  options= valued= subcommands= kinds= repeat=0
  case "$1" in
@commands@  esac
}

_fulmar() {
  local -a line before flight list
  local cur options valued subcommands kinds repeat kind='' command='' word skip=0 count=0
  read -ra line <<<"${COMP_LINE:0:COMP_POINT}"
  cur=${COMP_WORDS[COMP_CWORD]}
  [[ "${COMP_LINE:0:COMP_POINT}" == *[[:space:]] ]] || unset 'line[-1]'
  before=("${line[@]:1}")
  _fulmar_command ''
  local previous=''
  for word in "${before[@]}"; do
    if [[ $previous == --at || $previous == --token ]]; then flight+=("$previous" "$word"); fi
    if [[ $word == *.mcap ]]; then flight+=(--log "$word"); fi
    if ((skip)); then skip=0; previous=$word; continue; fi
    if [[ $word == --*=* ]]; then :
    elif [[ $word == -* ]]; then [[ $valued == *" $word "* ]] && skip=1
    elif [[ " $subcommands " == *" $word "* ]]; then command="${command:+$command }$word"; _fulmar_command "$command"; count=0
    else ((++count)); fi
    previous=$word
  done
  if ((skip)); then
    case "$previous" in
@options@    *) return ;;
    esac
  elif [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$cur")); return
  elif [[ $subcommands ]]; then
    ((count)) && return  # behind a program's name: its words are its own
    [[ $command ]] || subcommands+=" $("${COMP_WORDS[0]}" complete program 2>/dev/null)"
    COMPREPLY=($(compgen -W "$subcommands" -- "$cur")); return
  else
    list=($kinds)
    if ((count < ${#list[@]})); then kind=${list[count]}
    elif ((repeat)); then kind=${list[${#list[@]} - repeat + (count - ${#list[@]}) % repeat]}; fi
  fi
  case "$kind" in
    '' | none) ;;
    io) COMPREPLY=($(compgen -W 'sim fcu' -- "$cur")) ;;
    format) COMPREPLY=($(compgen -W 'text dot mermaid' -- "$cur")) ;;
    speed) COMPREPLY=($(compgen -W 'real max' -- "$cur")) ;;
    shell) COMPREPLY=($(compgen -W 'bash zsh' -- "$cur")) ;;
    drawn)
      mapfile -t COMPREPLY < <(compgen -f -X '!*.mcap' -- "$cur"; "${COMP_WORDS[0]}" complete "${flight[@]}" field "$cur" 2>/dev/null)
      [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *. ]] && compopt -o nospace 2>/dev/null ;;
    mission | plugin | log | file)
      local pattern='*'
      case "$kind" in mission) pattern='*.yaml' ;; plugin) pattern='*.so' ;; log) pattern='*.mcap' ;; esac
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -f -X "!$pattern" -- "$cur"; compgen -d -- "$cur") ;;
    *)
      mapfile -t COMPREPLY < <("${COMP_WORDS[0]}" complete "${flight[@]}" "$kind" "$cur" 2>/dev/null)
      [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *. ]] && compopt -o nospace 2>/dev/null ;;
  esac
  return 0
}
complete -F _fulmar fulmar
)bash";

constexpr const char* zsh_script = R"zsh(#compdef fulmar
# Completion of fulmar in zsh: fulmar completion zsh > a folder of $fpath/_fulmar
_fulmar_command() {  # sets options, valued, subcommands, kinds, repeat of a command
  options= valued= subcommands= kinds= repeat=0
  case "$1" in
@commands@  esac
}

_fulmar() {
  local options valued subcommands kinds repeat kind='' command='' word previous='' cur="${words[CURRENT]}"
  local -a flight list found
  integer skip=0 count=0 at
  _fulmar_command ''
  for word in "${(@)words[2,CURRENT-1]}"; do
    if [[ $previous == --at || $previous == --token ]]; then flight+=("$previous" "$word"); fi
    if [[ $word == *.mcap ]]; then flight+=(--log "$word"); fi
    if (( skip )); then skip=0; previous=$word; continue; fi
    if [[ $word == --*=* ]]; then :
    elif [[ $word == -* ]]; then [[ $valued == *" $word "* ]] && skip=1
    elif [[ " $subcommands " == *" $word "* ]]; then command="${command:+$command }$word"; _fulmar_command "$command"; count=0
    else (( ++count )); fi
    previous=$word
  done
  if (( skip )); then
    case "$previous" in
@options@    *) return 1 ;;
    esac
  elif [[ $cur == -* ]]; then
    compadd -- ${=options}; return
  elif [[ -n $subcommands ]]; then
    (( count )) && return 1  # behind a program's name: its words are its own
    [[ -n $command ]] || subcommands+=" $(${words[1]} complete program 2>/dev/null)"
    compadd -- ${=subcommands}; return
  else
    list=(${=kinds})
    if (( count < $#list )); then kind=${list[count + 1]}
    elif (( repeat )); then at=$(( $#list - repeat + (count - $#list) % repeat )); kind=${list[at + 1]}; fi
  fi
  case "$kind" in
    '' | none) return 1 ;;
    io) compadd -- sim fcu ;;
    format) compadd -- text dot mermaid ;;
    speed) compadd -- real max ;;
    shell) compadd -- bash zsh ;;
    mission) _files -g '*.yaml' ;;
    plugin) _files -g '*.so' ;;
    log) _files -g '*.mcap' ;;
    file) _files ;;
    drawn)
      _files -g '*.mcap'
      found=("${(@f)$(${words[1]} complete $flight field "$cur" 2>/dev/null)}")
      compadd -S '' -- ${found:#} ;;
    *)
      found=("${(@f)$(${words[1]} complete $flight "$kind" "$cur" 2>/dev/null)}")
      compadd -S '' -- ${found:#} ;;
  esac
}
_fulmar "$@"
)zsh";

// ---- words of a flight

void fields_of(const Type& type, const std::string& before, std::set<std::string>& words) {
  for (const Field& f : type.fields) {
    std::string name = before + shown_name(f.name);
    if (f.shape != FULMAR_SCALAR) name += "[0]";
    words.insert(f.kind == FULMAR_STRUCT ? name + "." : name);
  }
}

/// "nav.state." -> its fields; "nav.state.position_m.n" -> those of the struct.
void add_fields(Session& session, const std::string& prefix, std::set<std::string>& words) {
  const std::string path = prefix.substr(0, prefix.rfind('.') == std::string::npos ? 0 : prefix.rfind('.'));
  if (path.find('.') == std::string::npos) return;
  const PortField port = find_port(session, path);
  const Type* type = port.type.get();
  if (!port.field.empty()) {
    const FieldRef field = resolve_field(*type, port.field);
    type = field.field->kind == FULMAR_STRUCT ? field.field->type.get() : nullptr;
  }
  if (type) fields_of(*type, path + ".", words);
}

std::set<std::string> words_of(Session& session, const std::string& kind, const std::string& prefix) {
  std::set<std::string> words;
  if (kind == "port" || kind == "field") {
    for (const std::string& name : port_names(session)) words.insert(kind == "field" ? name + "." : name);
    add_fields(session, prefix, words);
    return words;
  }
  const json view = session.view();
  if (kind == "param")
    for (const NamedParam& p : params_of(view)) words.insert(p.name);
  if (kind == "phase")
    for (const std::string& phase : view.value("phases", std::vector<std::string>())) words.insert(phase);
  for (const json& c : view.value("components", json::array())) {
    const std::string name = c.value("name", "");
    if (kind == "component") words.insert(name);
    for (const json& p : c.value("inputs", json::array()))
      if (kind == "request" && p.value("request", false)) words.insert(name + "." + p.value("name", ""));
  }
  return words;
}

}  // namespace

std::string completion_script(const std::string& shell) {
  const std::string script = shell == "zsh" ? zsh_script : bash_script;
  return replaced(replaced(script, "@commands@", table()), "@options@", option_table());
}

std::vector<std::string> completions(Session& session, const std::string& kind, const std::string& prefix) {
  std::vector<std::string> list;
  for (const std::string& word : words_of(session, kind, prefix))
    if (word.starts_with(prefix)) list.push_back(word);
  return list;
}

int complete_command(const std::string& at, const std::string& token, const std::string& kind,
                     const std::string& prefix) {
  try {
    Session session(parse_target(at, token), std::chrono::milliseconds(500));
    for (const std::string& word : completions(session, kind, prefix)) std::printf("%s\n", word.c_str());
    return 0;
  } catch (const std::exception&) {
    return 1;
  }
}

int complete_from_log(const std::string& log, const std::string& prefix) {
  try {
    for (const std::string& word : numbers_beginning(log, prefix)) std::printf("%s\n", word.c_str());
    return 0;
  } catch (const std::exception&) {
    return 1;
  }
}

}  // namespace fulmar::core
