// The module by which SQLite reads a trace: one virtual table for each kind of event, read where it lies.
#pragma once

#include <exception>

#include "traces/file/trace.hpp"

struct sqlite3;

namespace zstep::query {

/// Makes a table of every kind that the trace can record. The trace must outlive the connection. What goes wrong in the
/// trace while a table is read (damage) is put into `fault` and ends the statement.
void make_tables(sqlite3* connection, const Trace& trace, std::exception_ptr& fault);

}  // namespace zstep::query
