// SPDX-License-Identifier: BSD-3-Clause
// Conditions: a recursive-descent compiler into a flat array of nodes, and its evaluation on the bytes of
// messages.
//   or = and {"or" and};  and = not {"and" not};  not = "not" not | "(" or ")" | side [compare side]
//   side = field | "time" | number [unit] | label;  compare = "<" | "<=" | ">" | ">=" | "==" | "!="
#include "core/graph/condition.hpp"

#include <algorithm>
#include <cctype>

#include "core/graph/messages.hpp"
#include "core/graph/quantity.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

enum class Op : std::uint8_t { both, either, opposite, compare };

struct Compare {
  std::string_view symbol, mirrored;  // "3 < x" is "x > 3"
  bool (*holds)(double a, double b) noexcept;
};
/// A symbol that begins with another one precedes it.
constexpr Compare compares[] = {{"<=", ">=", [](double a, double b) noexcept { return a <= b; }},
                                {">=", "<=", [](double a, double b) noexcept { return a >= b; }},
                                {"<", ">", [](double a, double b) noexcept { return a < b; }},
                                {">", "<", [](double a, double b) noexcept { return a > b; }},
                                {"==", "==", [](double a, double b) noexcept { return a == b; }},
                                {"!=", "!=", [](double a, double b) noexcept { return a != b; }}};

struct Condition::Node {
  struct Side : Shown {  // without a port: a constant, or the flight time
    bool is_time = false;
    double number = 0;  // of a constant
    double factor = 1;  // into the unit of the left side
  };
  Op op = Op::compare;
  int left = -1, right = -1;         // of both, either, opposite
  const Compare* compare = nullptr;  // of a and b; none: whether a is true
  Side a{}, b{};
};

namespace {

using CNode = Condition::Node;

const Compare* find_compare(std::string_view symbol) {
  const auto* const it = std::find_if(std::begin(compares), std::end(compares),
                                      [&](const Compare& c) { return c.symbol == symbol; });
  return it == std::end(compares) ? nullptr : it;
}

struct Token {
  enum class Kind : std::uint8_t { end, name, number, symbol } kind = Kind::end;
  std::string text;
};

class Lexer {
 public:
  explicit Lexer(const std::string& text) : text_(text) {}

  Token next() {
    skip_blanks();
    if (at_ >= text_.size()) return {};
    const char c = text_[at_];
    if (is_letter(c)) return {Token::Kind::name, take_name()};
    if (is_digit(c) || c == '.' ||
        ((c == '-' || c == '+') && at_ + 1 < text_.size() &&
         (is_digit(text_[at_ + 1]) || text_[at_ + 1] == '.')))
      return {Token::Kind::number, take_number()};
    const std::string_view rest = std::string_view(text_).substr(at_);
    for (const std::string_view symbol : {"<=", ">=", "==", "!=", "<", ">", "(", ")"})
      if (rest.starts_with(symbol)) {
        at_ += symbol.size();
        return {Token::Kind::symbol, std::string(symbol)};
      }
    for (const auto& [wrong, hint] : {std::pair{"&&", "write 'and'"}, std::pair{"||", "write 'or'"},
                                      std::pair{"!", "write 'not'"}, std::pair{"=", "write '==' to compare"}})
      if (rest.starts_with(wrong)) throw Error(graph_messages::operator_invalid(wrong, hint));
    throw Error(graph_messages::condition_text_invalid(text_.substr(at_, 12)));
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  /// Letters, digits, dots and indices: nav.state.position_m.north, plan.plan.waypoints[3].airspeed_mps
  std::string take_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.' ||
                                  text_[at_] == '[' || text_[at_] == ']'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// A number and, unless the next word is a keyword, its unit: "30 m", "-0.5 rad/s".
  std::string take_number() {
    const std::size_t begin = at_;
    ++at_;
    const auto exponent_sign = [&] {
      return (text_[at_] == '-' || text_[at_] == '+') && (text_[at_ - 1] == 'e' || text_[at_ - 1] == 'E');
    };
    const auto exponent = [&] {
      return (text_[at_] == 'e' || text_[at_] == 'E') && at_ + 1 < text_.size() &&
             (is_digit(text_[at_ + 1]) || text_[at_ + 1] == '-' || text_[at_ + 1] == '+');
    };
    while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.' || exponent() || exponent_sign()))
      ++at_;
    const std::size_t number_end = at_;
    skip_blanks();
    const std::size_t unit_begin = at_;
    const auto of_unit = [](char c) {
      return is_letter(c) || is_digit(c) || c == '/' || c == '^' || c == '%' ||
             static_cast<unsigned char>(c) >= 0x80;
    };
    while (at_ < text_.size() && of_unit(text_[at_])) ++at_;
    const std::string unit = text_.substr(unit_begin, at_ - unit_begin);
    if (unit == "and" || unit == "or" || unit == "not" || unit.empty()) {
      at_ = number_end;
      return text_.substr(begin, number_end - begin);
    }
    return text_.substr(begin, number_end - begin) + " " + unit;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

/// A probe carries one double without a name.
const Field& probe_field() {
  static const Field field{.kind = FULMAR_F64, .stride = sizeof(double)};
  return field;
}

/// The flight time, in conditions.
constexpr const char* time_word = "time";

const Field& time_field() {
  static const Field field{.name = time_word, .unit = "s", .kind = FULMAR_F64, .stride = sizeof(double)};
  return field;
}

class Compiler {
 public:
  Compiler(const std::string& text, const FindPort& find, std::vector<CNode>& nodes,
           std::vector<Source>& ports)
      : lexer_(text), find_(find), nodes_(nodes), ports_(ports) {
    advance();
  }

  int compile() {
    if (token_.kind == Token::Kind::end) throw Error(graph_messages::condition_empty());
    const int root = either();
    if (token_.text == ")") throw Error(graph_messages::parenthesis_unopened());
    if (token_.kind != Token::Kind::end) throw Error(graph_messages::conjunction_expected(token_.text));
    return root;
  }

 private:
  /// One side of a comparison as written.
  struct Operand {
    enum class Kind : std::uint8_t { field, number, label } kind = Kind::field;
    std::string text;
    CNode::Side side;
    Quantity quantity;
    bool is_enum() const { return kind == Kind::field && side.field.field->kind == FULMAR_ENUM; }
    bool is_bool() const { return kind == Kind::field && side.field.field->kind == FULMAR_BOOL; }
  };

  void advance() { token_ = lexer_.next(); }
  bool take(const char* word) {
    if (token_.kind == Token::Kind::end || token_.kind == Token::Kind::number || token_.text != word)
      return false;
    advance();
    return true;
  }
  int add(CNode node) {
    if (nodes_.size() >= std::size_t{most_parts}) throw Error(graph_messages::condition_too_long(most_parts));
    nodes_.push_back(std::move(node));
    return static_cast<int>(nodes_.size()) - 1;
  }
  int join_nodes(Op op, int left, int right) { return add({.op = op, .left = left, .right = right}); }

  int either() {
    int left = both();
    while (take("or")) left = join_nodes(Op::either, left, both());
    return left;
  }
  int both() {
    int left = opposite();
    while (take("and")) left = join_nodes(Op::both, left, opposite());
    return left;
  }
  int opposite() {
    if (++depth_ > deepest) throw Error(graph_messages::condition_too_deep(deepest));
    const int node = take("not") ? join_nodes(Op::opposite, opposite(), -1) : primary();
    --depth_;
    return node;
  }
  int primary() {
    if (!take("(")) return comparison();
    const int inside = either();
    if (!take(")")) throw Error(graph_messages::parenthesis_unclosed());
    return inside;
  }

  int comparison() {
    Operand a = operand();
    if (const Compare* compare = compare_here()) {
      advance();
      Operand b = operand();
      if (compare_here()) throw Error(graph_messages::comparison_chained());
      return add(compared(compare, std::move(a), std::move(b)));
    }
    if (a.kind == Operand::Kind::label) throw Error(graph_messages::operand_not_field(a.text));
    if (!a.is_bool()) throw Error(graph_messages::operand_not_boolean(a.text));
    return add({.a = a.side});
  }

  const Compare* compare_here() const {
    return token_.kind == Token::Kind::symbol ? find_compare(token_.text) : nullptr;
  }

  CNode compared(const Compare* compare, Operand a, Operand b) {
    if (a.kind != Operand::Kind::field) {  // 3 m < height: swap the sides
      if (b.kind != Operand::Kind::field)
        throw Error(graph_messages::comparison_without_field(a.text, compare->symbol, b.text));
      compare = find_compare(compare->mirrored);
      std::swap(a, b);
    }
    const bool ordered = compare->symbol != compare->mirrored;
    if ((a.is_enum() || a.is_bool() || b.is_enum() || b.is_bool()) && ordered)
      throw Error(graph_messages::operand_unordered((a.is_enum() || a.is_bool() ? a : b).text));
    if (b.kind == Operand::Kind::label || (b.side.is_time && a.is_enum()))  // a label of the field
      b = label(a, b.text);
    else if (b.kind == Operand::Kind::number)
      b.side.number = plain_number(a, b);
    else
      match_fields(a, b);
    CNode node;
    node.compare = compare;
    node.a = std::move(a.side);
    node.b = std::move(b.side);
    return node;
  }

  static Operand label(const Operand& field, const std::string& text) {
    Operand label;
    label.side.number = label_number(field, text);
    return label;
  }

  static double label_number(const Operand& field, const std::string& label) {
    if (field.is_bool()) {
      if (label == "true" || label == "false") return label == "true" ? 1 : 0;
      throw Error(graph_messages::flag_compared_to_label(field.text, label));
    }
    if (!field.is_enum()) throw Error(graph_messages::number_compared_to_label(field.text, label));
    const std::vector<std::string>& labels = field.side.field.field->labels;
    const auto it = std::find(labels.begin(), labels.end(), label);
    if (it == labels.end())
      throw Error(graph_messages::label_unknown(field.text, label, choices_text(label, labels)));
    return static_cast<double>(it - labels.begin());
  }

  static double plain_number(const Operand& field, const Operand& number) {
    if (field.is_enum())
      throw Error(graph_messages::label_expected(field.text, join(field.side.field.field->labels)));
    if (field.is_bool()) throw Error(graph_messages::flag_compared_to_number(field.text, number.text));
    try {
      return convert(number.quantity, field.side.field.unit, UnitRule::optional);
    } catch (const Error& fault) {
      throw Error(graph_messages::operand_fault(field.text, fault.diagnostic));
    }
  }

  static void match_fields(const Operand& a, Operand& b) {
    if (a.is_enum() != b.is_enum() || a.is_bool() != b.is_bool())
      throw Error(graph_messages::operands_incomparable(a.text, b.text));
    if (a.is_enum() && a.side.field.field->labels != b.side.field.field->labels)
      throw Error(graph_messages::labels_differ(a.text, b.text));
    const std::string &unit_a = a.side.field.unit, &unit_b = b.side.field.unit;
    if (!same_dimension(unit_a, unit_b))
      throw Error(graph_messages::units_differ(a.text, unit_a.empty() ? "plain numbers" : unit_a, b.text,
                                               unit_b.empty() ? "plain numbers" : unit_b));
    b.side.factor = unit_factor(unit_b, unit_a);
  }

  Operand operand() {
    Operand operand;
    operand.text = token_.text;
    if (token_.kind == Token::Kind::number) {
      operand.kind = Operand::Kind::number;
      operand.quantity = parse_quantity(token_.text);
    } else if (token_.kind == Token::Kind::name && token_.text != "and" && token_.text != "or" &&
               token_.text != "not") {
      if (token_.text == time_word)
        time(operand);
      else if (token_.text.find('.') == std::string::npos)
        operand.kind = Operand::Kind::label;
      else
        field(operand);
    } else {
      throw Error(token_.kind == Token::Kind::end ? graph_messages::operand_missing()
                                                  : graph_messages::operand_expected(token_.text));
    }
    advance();
    return operand;
  }

  static void time(Operand& operand) {
    operand.side.is_time = true;
    operand.side.field.field = &time_field();
    operand.side.field.unit = time_field().unit;
  }

  void field(Operand& operand) {
    const Shown& found = static_cast<Shown&>(operand.side) = find_shown(operand.text, find_);
    const fulmar_kind kind = found.field.field->kind;
    if (kind == FULMAR_STRUCT || kind == FULMAR_TEXT)
      throw Error(graph_messages::operand_not_scalar(
          operand.text, kind == FULMAR_TEXT ? "text" : "a " + found.field.field->type->name));
    if (std::find(ports_.begin(), ports_.end(), found.from) == ports_.end()) ports_.push_back(found.from);
  }

  Lexer lexer_;
  const FindPort& find_;
  std::vector<CNode>& nodes_;
  std::vector<Source>& ports_;
  Token token_;
  static constexpr int most_parts = 500, deepest = 50;
  int depth_ = 0;
};

/// Returns false when there is no such number: a list that is shorter than the index.
bool number_of(const CNode::Side& side, const SampleReader& reader, double& number) noexcept {
  if (side.is_time) {
    number = static_cast<double>(reader.now_ns()) / 1e9 * side.factor;
    return true;
  }
  if (side.from.kind == Source::Kind::none) {
    number = side.number;
    return true;
  }
  const std::byte* message = reader.sample(side.from);
  if (!message || !side.field.present(message)) return false;
  number = number_at(*side.field.field, message + side.field.offset) * side.factor;
  return true;
}

bool node_holds(const std::vector<CNode>& nodes, int index, const SampleReader& reader) noexcept {
  const CNode& node = nth(nodes, index);
  if (node.op == Op::both)
    return node_holds(nodes, node.left, reader) && node_holds(nodes, node.right, reader);
  if (node.op == Op::either)
    return node_holds(nodes, node.left, reader) || node_holds(nodes, node.right, reader);
  if (node.op == Op::opposite) return !node_holds(nodes, node.left, reader);
  double a = 0, b = 0;
  if (!number_of(node.a, reader, a)) return false;
  if (!node.compare) return a != 0;
  return number_of(node.b, reader, b) && node.compare->holds(a, b);
}

}  // namespace

Shown find_shown(const std::string& text, const FindPort& find) {
  const auto dot = text.find('.');
  const auto second = dot == std::string::npos ? dot : text.find('.', dot + 1);
  if (dot == std::string::npos) throw Error(graph_messages::operand_not_field(text));
  Shown shown{text, {}, {}, {}};
  const std::string owner = text.substr(0, dot),
                    port = text.substr(dot + 1, second == std::string::npos ? second : second - dot - 1);
  std::tie(shown.from, shown.type) = find(owner, port);
  if (!shown.type) {
    if (second != std::string::npos) throw Error(graph_messages::probe_without_fields(owner, port));
    shown.field.field = &probe_field();
    const auto suffixed = split_suffix(port);
    shown.field.unit = suffixed ? suffixed->unit : "";
    return shown;
  }
  if (second == std::string::npos)
    throw Error(
        graph_messages::field_name_missing(text, shown.type->name, join(names_of(shown.type->fields))));
  shown.field = resolve_field(*shown.type, text.substr(second + 1));
  return shown;
}

std::shared_ptr<const Condition> Condition::compile(const std::string& text, const FindPort& find) {
  auto condition = std::make_shared<Condition>();
  condition->text_ = text;
  condition->root_ = Compiler(text, find, condition->nodes_, condition->ports_).compile();
  return condition;
}

bool Condition::holds(const SampleReader& reader) const noexcept {
  for (const Source& port : ports_)
    if (!reader.sample(port)) return false;
  return node_holds(nodes_, root_, reader);
}

}  // namespace fulmar::core
