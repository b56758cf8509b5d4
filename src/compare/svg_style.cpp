#include "compare/svg_style.h"

#include <algorithm>

#include "compare/svg_values.h"

namespace inkgrid {
namespace {

constexpr std::pair<std::string_view, std::string SvgStyle::*> kProperties[] = {
    {"stroke", &SvgStyle::stroke},         {"fill", &SvgStyle::fill},       {"stroke-width", &SvgStyle::stroke_width},
    {"visibility", &SvgStyle::visibility}, {"display", &SvgStyle::display},
};

// Calls `use` with each part of the text between separators.
template <class Use>
void for_parts(std::string_view text, char separator, Use use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    use(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

Declarations parse_declarations(std::string_view text) {
  Declarations declarations;
  for_parts(text, ';', [&](std::string_view part) {
    const std::size_t colon = part.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view value = part.substr(colon + 1);
    declarations.emplace_back(trimmed(part.substr(0, colon)), trimmed(value.substr(0, value.find('!'))));
  });
  return declarations;
}

void apply(SvgStyle& style, std::string_view name, std::string_view value) {
  for (const auto& [known, member] : kProperties)
    if (name == known && value != "inherit") style.*member = value;
}

void apply(SvgStyle& style, const Declarations& declarations) {
  for (const auto& [name, value] : declarations) apply(style, name, value);
}

std::string without_comments(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find("/*"), text.size());
    result += text.substr(0, begin);
    const std::size_t end = text.find("*/", begin);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
  }
  return result;
}

// False where the selector is of a kind that is not understood.
bool parse_selector(std::string_view selector, CssRule& rule) {
  selector = trimmed(selector);
  selector.remove_prefix(selector.find_last_of(" \t\r\n") + 1);
  if (selector.empty() || selector.find_first_of(">+~[:") != std::string_view::npos) return false;
  const std::size_t first = std::min(selector.find_first_of(".#"), selector.size());
  rule.tag = selector.substr(0, first) == "*" ? "" : selector.substr(0, first);
  for (selector.remove_prefix(first); !selector.empty();) {
    const std::size_t end = std::min(selector.find_first_of(".#", 1), selector.size());
    rule.marks.emplace_back(selector.substr(0, end));
    selector.remove_prefix(end);
  }
  return true;
}

bool has_class(const XmlElement& element, std::string_view name) {
  bool found = false;
  if (const std::string* classes = element.find("class"))
    for_parts(*classes, ' ', [&](std::string_view word) { found = found || trimmed(word) == name; });
  return found;
}

bool matches(const CssRule& rule, const XmlElement& element) {
  if (!rule.tag.empty() && rule.tag != element.tag) return false;
  const std::string* id = element.find("id");
  return std::all_of(rule.marks.begin(), rule.marks.end(), [&](const std::string& mark) {
    const std::string_view name = std::string_view(mark).substr(1);
    return mark[0] == '.' ? has_class(element, name) : id != nullptr && *id == name;
  });
}

}  // namespace

std::vector<CssRule> parse_css(std::string_view text) {
  const std::string plain = without_comments(text);
  std::vector<CssRule> rules;
  std::string_view selectors;  // of the block that is open
  std::size_t start = 0;
  for (std::size_t i; (i = plain.find_first_of("{}", start)) != std::string::npos; start = i + 1) {
    const std::string_view before = std::string_view(plain).substr(start, i - start);
    if (plain[i] == '{') {
      selectors = before;
      continue;
    }
    for_parts(selectors, ',', [&](std::string_view selector) {
      CssRule rule{{}, {}, parse_declarations(before)};
      if (parse_selector(selector, rule)) rules.push_back(std::move(rule));
    });
    selectors = {};
  }
  return rules;
}

SvgStyle style_of(const XmlElement& element, const SvgStyle& inherited, const std::vector<CssRule>& rules) {
  SvgStyle style = inherited;
  for (const auto& [name, value] : element.attributes) apply(style, name, trimmed(value));
  for (const CssRule& rule : rules)
    if (matches(rule, element)) apply(style, rule.declarations);
  if (const std::string* own = element.find("style")) apply(style, parse_declarations(*own));
  return style;
}

bool is_paint(std::string_view value) {
  return value != "none" && value != "transparent";
}

}  // namespace inkgrid
