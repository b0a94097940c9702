// Words of users and file names: the nearest known word, and printable text for messages.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace barchan {

/// Candidate nearest to `typed` by edits (a swap of neighbours counts once); empty if none is near
/// enough to be meant.
std::string nearest(std::string_view typed, std::span<const std::string> candidates);

/// Hint " (did you mean "restitution"?)"; empty if `close` is.
std::string did_you_mean(std::string_view close);

/// Hint " (did you mean configs/quickstart.toml?)" for a `path` that is not there: with the ending
/// .toml, in the folder configs, or the file of its kind beside it whose name is nearest; empty if
/// there is none.
std::string nearest_file(const std::filesystem::path& path);

/// Name of a case, and so of its run folder in runs/ by default: the path of its file below the
/// last folder called configs, or else the name of the file, without its last ending. The launcher
/// (default_run_dir) and Python (run_name) have the same rule.
std::filesystem::path case_name(const std::filesystem::path& file);

/// Folder with the run folders of cases that the case `file` starts from, each by its name: runs/
/// if `folder`, that of its own run, is runs/NAME or beside it; else the folder that `folder` is
/// in.
std::filesystem::path folder_of_runs(const std::filesystem::path& file,
                                     const std::filesystem::path& folder);

/// Text for a terminal, with control characters and bytes that are not UTF-8 spelt out as
/// , \x1b, \xff; `longest` bytes at most, then "...".
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// Message of several lines for a terminal, as printable(); the lines stay.
std::string printable_lines(std::string_view text);

/// Names as one text for a file, a line each, and back.
std::string as_lines(std::span<const std::string> names);
std::vector<std::string> lines_of(std::string_view text);

}  // namespace barchan
