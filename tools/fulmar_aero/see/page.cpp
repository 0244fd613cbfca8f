// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/see/page.hpp"

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "core/graph/shipped.hpp"
#include "tools/chart/chart.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/see/messages.hpp"

namespace fulmar::aero {

using chart::in_html;

namespace {

// Colours of Okabe & Ito, Color Universal Design (2008), adapted to the background; dashes distinguish lines
// further.
constexpr const char* style_sheet = R"(
:root{color-scheme:light dark;--page:#fff;--text:#1c1c1c;--pale:#666;--grid:#e2e2e2;--zero:#9a9a9a;--bad:#fbeaea;
--c0:#0072b2;--c1:#c04f00;--c2:#007a5a;--c3:#b0558a;--c4:#8f6600;--c5:#1f7fb8}
@media (prefers-color-scheme:dark){:root{--page:#16181b;--text:#e6e6e6;--pale:#a0a0a0;--grid:#33373c;--zero:#70757b;
--bad:#3a2326;--c0:#56b4e9;--c1:#ff8f3f;--c2:#2fc79b;--c3:#e29cc4;--c4:#f0c040;--c5:#9ad0f5}}
body{background:var(--page);color:var(--text);font:15px/1.45 system-ui,sans-serif;max-width:90em;margin:1.5em auto;padding:0 1em}
h1{font-size:1.5em}h2{font-size:1.2em;margin-top:1.8em;border-bottom:1px solid var(--grid)}h1,h2,td,th,li,p{overflow-wrap:anywhere}
.charts{margin:.8em 0;display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,26em),1fr));gap:1em 1.5em}
figure{margin:0;break-inside:avoid}figcaption{font-weight:600;padding-left:1em}figure>svg{width:100%;height:auto;display:block}
svg text{font:11px system-ui,sans-serif;fill:var(--text)}text.x,text.xaxis,text.yaxis{text-anchor:middle}text.y{text-anchor:end}
text.xaxis,text.yaxis{font-size:12px}path{fill:none}.grid{stroke:var(--grid)}.zero{stroke:var(--zero)}.frame{stroke:var(--zero)}
.unstable{fill:var(--bad)}.line{stroke-width:1.8;stroke-linejoin:round}.mark{stroke-width:1.2}.thin{stroke-width:.6;opacity:.6}
.plain{stroke:var(--pale)}.mark.plain{fill:none}
.s0{stroke:var(--c0)}.s1{stroke:var(--c1)}.s2{stroke:var(--c2)}.s3{stroke:var(--c3)}.s4{stroke:var(--c4)}.s5{stroke:var(--c5)}
.mark.s0{fill:var(--c0)}.mark.s1{fill:var(--c1)}.mark.s2{fill:var(--c2)}.mark.s3{fill:var(--c3)}.mark.s4{fill:var(--c4)}.mark.s5{fill:var(--c5)}
.line.s1{stroke-dasharray:8 4}.line.s2{stroke-dasharray:2 3}.line.s3{stroke-dasharray:9 3 2 3}.line.s4{stroke-dasharray:14 3}.line.s5{stroke-dasharray:5 2 1 2 1 2}
.mark,.thin{stroke-dasharray:none!important}
.legend{list-style:none;margin:.1em 0 0;padding:0 0 0 1em;display:flex;flex-wrap:wrap;gap:.1em 1.2em;font-size:.85em}
.sample{width:2.6em;height:.95em;margin-right:.4em;vertical-align:middle}
table{border-collapse:collapse;margin:.6em 0}td,th{padding:.15em .8em;text-align:right;border-bottom:1px solid var(--grid)}
tbody th,thead th:first-child{text-align:left;font-weight:normal}thead th{vertical-align:bottom}.wide{overflow-x:auto}
.fault{border-left:4px solid var(--c1);padding-left:.8em}footer{color:var(--pale);font-size:.85em;margin-top:2em}
@media print{:root{--page:#fff;--text:#000;--pale:#555;--grid:#ddd;--zero:#999;--bad:#fbeaea;
--c0:#0072b2;--c1:#c04f00;--c2:#007a5a;--c3:#b0558a;--c4:#8f6600;--c5:#1f7fb8}body{max-width:none;margin:0;font-size:10pt}
.charts{grid-template-columns:1fr 1fr}h2{break-after:avoid}tr{break-inside:avoid}}
)";

}  // namespace

std::string page_html(const std::string& title, const std::string& body) {
  // no scripts and no requests, for any text in a name
  return std::string("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
         "'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         in_html(title) + "</title>\n<style>" + style_sheet + "</style>\n</head>\n<body>\n<h1>" +
         in_html(title) + "</h1>\n" + body + "</body>\n</html>\n";
}

std::string table_html(const std::vector<std::vector<std::string>>& rows) {
  std::string out = "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 0) out += "<thead>";
    if (i == 1) out += "<tbody>";
    out += "<tr>";
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      const std::string cell = i == 0 || k == 0 ? "th" : "td";
      out += "<" + cell + ">" + in_html(rows[i][k]) + "</" + cell + ">";
    }
    out += i == 0 ? "</tr></thead>\n" : "</tr>\n";
  }
  return out + (rows.size() > 1 ? "</tbody>" : "") + "</table></div>\n";
}

std::string sentence_html(const std::string& text) { return "<p>" + in_html(text) + "</p>\n"; }

void refuse_as_page(const std::string& page, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code none;
    if (std::filesystem::equivalent(page, core::named_file({}, input), none))
      throw core::Error(aero_messages::page_is_input(page));
  }
}

void write_page(const std::string& file, const std::string& html) {
  std::ofstream out(file, std::ios::binary);
  out << html;
  out.close();
  if (!out) throw core::Error(aero_messages::picture_not_writable(file));
}

}  // namespace fulmar::aero
