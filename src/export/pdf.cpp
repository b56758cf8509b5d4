// PDF 1.4, one page, uncompressed.
#include "export/page.h"
#include "export/writers.h"

namespace inkgrid {
namespace {

// Objects numbered from 1 in the order they are added, then the table of where each begins.
class PdfFile {
 public:
  void add(const std::string& object) {
    begins_.push_back(text_.size());
    text_ += std::to_string(begins_.size()) + " 0 obj\n" + object + "\nendobj\n";
  }

  std::string finished(const std::string& trailer) && {
    const std::string begin_of_table = std::to_string(text_.size());
    const std::string count = std::to_string(begins_.size() + 1);
    text_ += "xref\n0 " + count + "\n0000000000 65535 f \n";
    for (const std::size_t begin : begins_) {
      const std::string digits = std::to_string(begin);
      text_ += std::string(10 - digits.size(), '0') + digits + " 00000 n \n";
    }
    return text_ + "trailer\n<< /Size " + count + ' ' + trailer + " >>\nstartxref\n" + begin_of_table + "\n%%EOF\n";
  }

 private:
  std::string text_ = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";  // the second line tells transports that this is no text
  std::vector<std::size_t> begins_;
};

}  // namespace

std::string pdf_text(const Drawing& drawing, const ExportOptions& options, const std::string& description) {
  const Page page = page_of(drawing, options);
  PdfFile file;
  file.add("<< /Type /Catalog /Pages 2 0 R >>");
  file.add("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
  file.add("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " + decimal(page.width, kPagePlaces) + ' ' +
           decimal(page.height, kPagePlaces) + "] /Contents 4 0 R /Resources << >> >>");
  file.add("<< /Length " + std::to_string(page.content.size()) + " >>\nstream\n" + page.content + "endstream");
  file.add("<< /Producer (inkgrid) /Subject " + parenthesised(description) + " >>");
  return std::move(file).finished("/Root 1 0 R /Info 5 0 R");
}

}  // namespace inkgrid
