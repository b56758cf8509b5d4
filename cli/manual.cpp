#include "manual.h"

#include "arguments.h"
#include "base/decimal.h"
#include "compare_command.h"
#include "inkgrid/inkgrid.h"
#include "options.h"

namespace inkgrid::cli {
namespace {

constexpr std::string_view kSummary = "line drawings to vector curves";
constexpr std::string_view kUsage = "inkgrid [OPTION]... DRAWING...";
constexpr std::string_view kDescription =
    "Finds the curves that the strokes of a drawing follow, joined where they meet, and writes them beside the drawing, as SVG "
    "or in the format that the extension of the output names. A drawing is a PNG, JPEG, TIFF, WebP, BMP or PNM file, or - for "
    "standard input. inkgrid studio [FILE] opens a page in the browser where the method can be watched and steered; "
    "inkgrid studio --help says more.";
constexpr std::string_view kFormats = "The extension of an output, or --format, is one of:";
constexpr std::string_view kCompareUsage = "inkgrid compare [OPTION]... RESULT.svg TRUTH.svg";
constexpr std::string_view kStudioUsage = "inkgrid studio [OPTION]... [FILE]";
constexpr std::string_view kCompareDescription =
    "Measures how near the curves of RESULT are to those of TRUTH and prints the measures, which docs/EVALUATION.md defines. "
    "Both are SVG files, or - for standard input; RESULT is fitted to the page of TRUTH.";
constexpr std::string_view kParameters =
    "Lengths in strokes are multiples of the drawing's average stroke width. Sections are those of the paper that the method "
    "follows: Integer-Grid Sketch Simplification and Vectorization, Stanko et al., 2020.";
constexpr std::string_view kExitStatus[][2] = {
    {"0", "the curves were written"},
    {"1", "the command line, or an option, is wrong"},
    {"2", "a file can't be read, understood or written"},
    {"3", "the numerics failed"},
};

constexpr std::size_t kIndent = 8;
constexpr std::size_t kColumns = 80;

// One entry of either table, as text.
struct Entry {
  std::string flags;  // "-o, --output FILE"
  std::string help;
};

std::string flags_of(const auto& option) {
  std::string flags = option.letter.empty() ? "" : std::string(option.letter) + ", ";
  flags += option.name;
  if (!option.value.empty()) flags.append(" ").append(option.value);
  return flags;
}

Entry entry_of(const CommandOption& option) {
  return {flags_of(option), std::string(option.help)};
}

Entry entry_of(const CompareOption& option) {
  std::string help(option.help);
  if (const auto* number = std::get_if<double CompareOptions::*>(&option.member))
    help += "; default " + decimal(CompareOptions{}.**number, 3);
  return {flags_of(option), help};
}

std::string value_name(const OptionRow& row) {
  if (is_name(row)) return "NAME";
  return std::holds_alternative<int Options::*>(row.member) ? "COUNT" : "NUMBER";
}

Entry entry_of(const OptionRow& row) {
  std::string help = std::string(row.help) + "; " + accepted_values(row) + "; default " + option_text(Options{}, row);
  if (!row.section.empty()) help.append("; section ").append(row.section);
  return {"--" + std::string(row.name) + " " + value_name(row), help};
}

std::string value_name(const ExportOptionRow& row) {
  const bool chosen = std::holds_alternative<LengthUnit ExportOptions::*>(row.member) ||
                      std::holds_alternative<DxfCurves ExportOptions::*>(row.member);
  return chosen ? "NAME" : "NUMBER";
}

Entry entry_of(const ExportOptionRow& row) {
  return {"--" + std::string(row.name) + " " + value_name(row),
          std::string(row.help) + "; " + accepted_values(row) + "; default " + option_text(ExportOptions{}, row)};
}

Entry entry_of(const ExportFormat& format) {
  return {std::string(format.name), std::string(format.help)};
}

// Broken between words, each line indented.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string result;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    const bool fits = column > 0 && column + 1 + word.size() <= kColumns;
    if (!fits) result += (column > 0 ? "\n" : "") + std::string(indent, ' ');
    if (fits) result += ' ';
    result += word;
    column = (fits ? column + 1 : indent) + word.size();
  }
  return result + "\n";
}

std::string help_entry(const Entry& entry) {
  return "  " + entry.flags + "\n" + wrapped(entry.help, kIndent);
}

std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

std::string roff_entry(const Entry& entry) {
  return ".TP\n.B " + roff(entry.flags) + "\n" + roff(entry.help) + ".\n";
}

template <class Format>
std::string all_entries(const auto& table, Format format) {
  std::string text;
  for (const auto& row : table) text += format(entry_of(row));
  return text;
}

}  // namespace

std::string compare_help_text() {
  return "Usage: " + std::string(kCompareUsage) + "\n\n" + wrapped(kCompareDescription, 0) + "\n" +
         all_entries(compare_options(), help_entry);
}

std::string help_text() {
  std::string text = "Usage: " + std::string(kUsage) + "\n       " + std::string(kCompareUsage) + "\n       " +
                     std::string(kStudioUsage) + "\n\n";
  text += wrapped(kDescription, 0) + "\n";
  text += all_entries(command_options(), help_entry);
  text += "\n" + wrapped("Formats. " + std::string(kFormats), 0) + "\n";
  text += all_entries(export_formats(), help_entry) + all_entries(export_option_table(), help_entry);
  text += "\n" + wrapped("Parameters of the method. " + std::string(kParameters), 0) + "\n";
  text += all_entries(option_table(), help_entry);
  text += "\nExit status:\n";
  for (const auto& [code, meaning] : kExitStatus) text.append("  ").append(code).append("  ").append(meaning).append("\n");
  return text;
}

std::string manual_page() {
  std::string text = ".TH INKGRID 1 \"\" \"inkgrid " + std::string(version()) + "\" \"User Commands\"\n";
  text += ".SH NAME\ninkgrid \\- " + roff(kSummary) + "\n";
  text += ".SH SYNOPSIS\n.B inkgrid\n[\\fIOPTION\\fR]... \\fIDRAWING\\fR...\n";
  text += ".br\n.B inkgrid compare\n[\\fIOPTION\\fR]... \\fIRESULT.svg\\fR \\fITRUTH.svg\\fR\n";
  text += ".br\n.B inkgrid studio\n[\\fIOPTION\\fR]... [\\fIFILE\\fR]\n";
  text += ".SH DESCRIPTION\n" + roff(kDescription) + "\n";
  text += ".SH OPTIONS\n" + all_entries(command_options(), roff_entry);
  text += ".SH FORMATS\n" + roff(kFormats) + "\n" + all_entries(export_formats(), roff_entry) +
          all_entries(export_option_table(), roff_entry);
  text += ".SH PARAMETERS\n" + roff(kParameters) + "\n" + all_entries(option_table(), roff_entry);
  text += ".SH COMPARE\n" + roff(kCompareDescription) + "\n" + all_entries(compare_options(), roff_entry);
  text += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : kExitStatus) text += roff_entry({std::string(code), std::string(meaning)});
  text += ".SH EXAMPLES\n.nf\n" + roff("inkgrid drawing.png\ninkgrid sketch.jpg --preset rough --spacing 3 -o curves.svg\n") +
          roff("inkgrid drawing.png -o cut.dxf -o print.pdf --unit mm\nscanimage --format=png | inkgrid - > curves.svg\n") +
          ".fi\n";
  return text;
}

}  // namespace inkgrid::cli
