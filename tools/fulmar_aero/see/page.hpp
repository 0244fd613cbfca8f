// SPDX-License-Identifier: BSD-3-Clause
// A self-contained page: no script, no request; light and dark, and for paper.
#pragma once
#include <string>
#include <vector>

namespace fulmar::aero {

/// `body` is HTML.
std::string page_html(const std::string& title, const std::string& body);

/// Cells are plain texts. The first row is the head, the first column names the rows.
std::string table_html(const std::vector<std::vector<std::string>>& rows);

std::string sentence_html(const std::string& text);

/// Throws core::Error when the page would replace one of its sources.
void refuse_as_page(const std::string& page, const std::vector<std::string>& inputs);

/// Throws core::Error when the file cannot be written.
void write_page(const std::string& file, const std::string& html);

}  // namespace fulmar::aero
