// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::six_dof_messages {

inline constexpr MessageText cell_count_mismatch{
    "six_dof.cell_count_mismatch", {"found", "expected"}, "{found} cells, where the header has {expected}"};
inline constexpr MessageText check_cases_missing{
    "six_dof.check_cases_missing",
    {"folder"},
    "there are no check cases of NASA/TM-2015-218675 in '{folder}'"};
inline constexpr MessageText column_missing{"six_dof.column_missing", {"column"}, "no column '{column}'"};
inline constexpr MessageText file_empty{"six_dof.file_empty", "the file is empty"};
inline constexpr MessageText file_not_readable{
    "six_dof.file_not_readable", {"file"}, "{file}: cannot be read"};
inline constexpr MessageText first_column_not_time{"six_dof.first_column_not_time",
                                                   "the first column is not 'time'"};
inline constexpr MessageText number_expected{"six_dof.number_expected", {"found"}, "'{found}' is no number"};
inline constexpr MessageText recording_short{
    "six_dof.recording_short", {"end"}, "the recording ends at {end} s, before 30 s"};
inline constexpr MessageText recordings_missing{
    "six_dof.recordings_missing",
    {"folder", "check_case"},
    "'{folder}' has no three recordings of check case {check_case}"};
inline constexpr MessageText row_missing{"six_dof.row_missing", {"time"}, "no row at {time} s"};
inline constexpr MessageText time_backwards{"six_dof.time_backwards", "the time runs backwards"};
inline constexpr MessageText usage{"six_dof.usage", "usage: bench_six_dof DIR [--json]"};

}  // namespace fulmar::six_dof_messages
