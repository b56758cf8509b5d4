#include "compare/xml.h"

#include <expat.h>

#include <exception>
#include <memory>

#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr std::size_t kDeepest = 500;  // elements in one another: trees are walked by recursion
constexpr std::size_t kPiece = 1 << 20;

struct Parse {
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser{XML_ParserCreate(nullptr), &XML_ParserFree};
  XmlElement root;                  // above the element of the document
  std::vector<XmlElement*> open{};  // the last child of each is the next one
  bool too_deep = false;
  std::exception_ptr failure;  // what was thrown in a callback: it may not pass through C
};

// Runs `action`, and stops the parser at an exception.
template <class Action>
void guarded(void* data, Action action) {
  Parse& parse = *static_cast<Parse*>(data);
  if (parse.failure || parse.too_deep) return;
  try {
    action(parse);
  } catch (...) {
    parse.failure = std::current_exception();
  }
  if (parse.failure || parse.too_deep) XML_StopParser(parse.parser.get(), XML_FALSE);
}

std::string local_name(std::string_view name) {
  return std::string(name.substr(name.rfind(':') + 1));
}

void start_element(void* data, const XML_Char* name, const XML_Char** attributes) {
  guarded(data, [&](Parse& parse) {
    parse.too_deep = parse.open.size() > kDeepest;
    XmlElement& element = parse.open.back()->children.emplace_back();
    element.tag = local_name(name);
    for (; *attributes != nullptr; attributes += 2) element.attributes.emplace_back(attributes[0], attributes[1]);
    parse.open.push_back(&element);
  });
}

void end_element(void* data, const XML_Char*) {
  guarded(data, [](Parse& parse) { parse.open.pop_back(); });
}

void characters(void* data, const XML_Char* text, int length) {
  guarded(data, [&](Parse& parse) { parse.open.back()->text.append(text, static_cast<std::size_t>(length)); });
}

[[noreturn]] void refuse(const Parse& parse, const std::string& name) {
  if (parse.failure) std::rethrow_exception(parse.failure);
  const std::string problem =
      parse.too_deep ? "elements are nested too deep" : XML_ErrorString(XML_GetErrorCode(parse.parser.get()));
  const auto line = std::to_string(XML_GetCurrentLineNumber(parse.parser.get()));
  throw Error(ErrorCode::file, "'" + name + "' is no SVG file: line " + line + ": " + problem);
}

}  // namespace

const std::string* XmlElement::find(std::string_view name) const {
  for (const auto& [key, value] : attributes)
    if (key == name) return &value;
  return nullptr;
}

XmlElement parse_xml(std::string_view text, const std::string& name) {
  Parse parse;
  if (!parse.parser) throw std::bad_alloc();
  parse.open = {&parse.root};
  XML_SetUserData(parse.parser.get(), &parse);
  XML_SetElementHandler(parse.parser.get(), start_element, end_element);
  XML_SetCharacterDataHandler(parse.parser.get(), characters);
  for (bool last = false; !last;) {
    const std::string_view piece = text.substr(0, kPiece);
    text.remove_prefix(piece.size());
    last = text.empty();
    if (XML_Parse(parse.parser.get(), piece.data(), static_cast<int>(piece.size()), last) != XML_STATUS_OK) refuse(parse, name);
  }
  return std::move(parse.root.children.front());
}

}  // namespace inkgrid
