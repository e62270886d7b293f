#pragma once

#include <string>
#include <vector>

#include "bench/compare/history.h"
#include "bench/compare/row.h"
#include "bench/report/html/pictures.h"
#include "bench/report/published.h"

namespace ptb {

/// A run and its pictures, as a page shows them.
struct PageRun {
    ResultFile result;
    std::vector<Figure> figures;
    std::string name{};  ///< among several: what tells its file from theirs
};

/// One self-contained HTML file of one or several runs: it needs no other file and asks nothing of a network.
/// Without JavaScript tables and pictures are there; with it charts, sorting, filtering, wiping and each
/// case's record.
std::string page(const std::vector<PageRun>& runs, const PublishedTable& published);

/// What a page of a comparison is made from.
struct ComparedPage {
    std::vector<Row> rows;
    std::string title;                   ///< "base: ...; new: ..."
    std::vector<std::string> differing;  ///< facts in which the sides differ
    std::string json;                    ///< of the comparison, to download
};
std::string compared_page(const ComparedPage& compared);

/// A history as one such file: without JavaScript its tables, with a drawn trend in each line; with it
/// charts.
std::string history_page(const History& history);

}  // namespace ptb
