#include "sim/homework/emitter_texts.hpp"

namespace zstep::homework::emitter_texts {

const std::string_view c_begin =
    R"text(/* Writes a run, a line a step, with the place that printed it; zstep reads it.)text"
    R"text( Depths may be INFINITY. C99 and C++.
   With $NAME_OFF defined nothing of it is compiled. $NAME_OUT: where it goes, standard output if it is not defined. */
#ifndef $NAME_H
#define $NAME_H
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#ifndef $NAME_OUT
#define $NAME_OUT stdout
#endif
#ifdef $NAME_OFF
#define $NAME_STEP(...) ((void)0)
#else
#define $NAME_STEP(...) $name_step(__FILE__, __LINE__, __VA_ARGS__)
#endif

static inline void $name_text(const char* text) {
  for (; *text; ++text) {
    if (*text == '"' || *text == '\\') putc('\\', $NAME_OUT);
    putc(*text, $NAME_OUT);
  }
}
/* fields: "x:i z:r nearer:b why:w": int, double, 0 or 1, text */
static inline void $name_step(const char* file, int line, const char* step, const char* fields, ...) {
  va_list values;
  va_start(values, fields);
  fprintf($NAME_OUT, "{\"step\":\"%s\"", step);
  while (*fields) {
    fputs(",\"", $NAME_OUT);
    while (*fields != ':') putc(*fields++, $NAME_OUT);
    fputs("\":", $NAME_OUT);
    if (fields[1] == 'i') fprintf($NAME_OUT, "%d", va_arg(values, int));
    if (fields[1] == 'b') fputs(va_arg(values, int) ? "true" : "false", $NAME_OUT);
    if (fields[1] == 'w') fprintf($NAME_OUT, "\"%s\"", va_arg(values, const char*));
    if (fields[1] == 'r') {
      const double value = va_arg(values, double);
      if (isfinite(value)) fprintf($NAME_OUT, "%.17g", value);
      else fputs(isnan(value) ? "\"nan\"" : value > 0 ? "\"inf\"" : "\"-inf\"", $NAME_OUT);
    }
    fields += fields[2] == ' ' ? 3 : 2;
  }
  va_end(values);
  fputs(",\"at\":\"", $NAME_OUT);
  $name_text(file);
  fprintf($NAME_OUT, ":%d\"}\n", line);
}
)text";
const std::string_view c_header =
    R"text(
static const char* const $name_header_text[] = {$header0};
/* The first line of the run: this file's text; of 0 the header that was given when this file was made. */
static inline void $name_header(const char* file) {
#ifndef $NAME_OFF
  const char* const* text = $name_header_text;
  FILE* in = file ? fopen(file, "rb") : 0;
  if (file ? !in : !*text) {
    fprintf(stderr, "%s: cannot be read; make it with: zstep header SCENE -o head.jsonl\n", file ? file : "header");
    exit(1);
  }
  for (; !in && *text; ++text) fputs(*text, $NAME_OUT);
  for (int c = 0, last = '\n'; in && ((c = getc(in)) != EOF || last != '\n'); last = c))text"
    R"text( putc(c == EOF ? c = '\n' : c, $NAME_OUT);
  if (in) fclose(in);
  else putc('\n', $NAME_OUT);
#else
  (void)file;
#endif
}
)text";

const std::string_view cpp_begin =
    R"text(// Writes a run, a line a step, with the place that printed it; zstep reads it.)text"
    R"text( Depths may be infinite. C++11.
// With $NAME_OFF defined each call is empty. It goes to standard output, or to what $name::out() is set to.
#pragma once
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace $name {

#ifdef $NAME_OFF
constexpr bool on = false;
#else
constexpr bool on = true;
#endif

inline std::FILE*& out() {
  static std::FILE* file = stdout;
  return file;
}

struct Place {
  const char* file;
  int line;
};

struct Field {
  std::string text;
  Field(const char* name, const std::string& value) : text(std::string(",\"") + name + "\":" + value) {}
  Field(const char* name, int value) : Field(name, std::to_string(value)) {}
  Field(const char* name, bool value) : Field(name, std::string(value ? "true" : "false")) {}
  Field(const char* name, const char* value) : Field(name, "\"" + std::string(value) + "\"") {}
  Field(const char* name, double value) : Field(name, of_real(value)) {}
  static std::string of_real(double value) {
    if (std::isnan(value)) return "\"nan\"";
    if (std::isinf(value)) return value > 0 ? "\"inf\"" : "\"-inf\"";
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    return digits;
  }
};

template <class... Fields>
inline void step(const char* name, Place at, const Fields&... fields) {
  std::string line = std::string("{\"step\":\"") + name + "\"";
  const int each[] = {0, (line += fields.text, 0)...};
  (void)each;
  line += ",\"at\":\"";
  for (const char* c = at.file; *c; ++c) line += (*c == '"' || *c == '\\') ? std::string("\\") + *c :)text"
    R"text( std::string(1, *c);
  line += ":" + std::to_string(at.line) + "\"}\n";
  std::fputs(line.c_str(), out());
}

)text";
const std::string_view cpp_header =
    R"text(
/// The first line of the run: the text of this file, or else the header that was given when this file was made.
inline void header(const char* file = nullptr) {
  if (!on) return;
  std::string text;
  for (const char* piece : {$header"",}) text += piece;
  if (file != nullptr) {
    text.clear();
    if (std::FILE* in = std::fopen(file, "rb")) {
      for (int c = std::getc(in); c != EOF; c = std::getc(in)) text += static_cast<char>(c);
      std::fclose(in);
    }
  }
  if (text.empty()) {
    std::fprintf(stderr, "%s: cannot be read; make it with:)text"
    R"text( zstep header SCENE -o head.jsonl\n", file ? file : "header");
    std::exit(1);
  }
  if (text.back() != '\n') text += '\n';
  std::fputs(text.c_str(), out());
}
)text";

const std::string_view python_begin =
    R"text("""Writes a run, a line a step, with the place that printed it; zstep reads it. Depths may be math.inf.

on = False: nothing is written. It goes to `out`, standard output at first."""
import json
import math
import os
import sys

on, out = True, sys.stdout
_places = {}

def _place(file, line):
    try:
        near = os.path.relpath(file)
    except ValueError:  # on another drive
        near = ".."
    return "%s:%d" % (os.path.basename(file) if near.startswith("..") else near, line)

def _whole(value):  # as what is no whole number is to be seen
    return int(value) if int(value) == value else value

def _real(value):
    return float(value) if math.isfinite(value) else str(float(value))

def _step(name, fields):
    if not on:
        return
    caller = sys._getframe(2)
    key = caller.f_code.co_filename, caller.f_lineno
    if key not in _places:
        _places[key] = _place(*key)
    out.write(json.dumps({"step": name, **fields, "at": _places[key]}) + "\n")

)text";
const std::string_view python_header =
    R"text(
_header = "".join([$header])

def header(file=None):  # the first line of the run: this file's text, or the header given when zstep.py was made
    if not on:
        return
    if file is None and not _header:
        sys.exit("header: name its file; zstep header SCENE -o head.jsonl makes one")
    text = _header
    if file is not None:
        with open(file, encoding="utf-8") as opened:
            text = opened.read()
    out.write(text.rstrip("\n") + "\n")
)text";

const std::string_view javascript_begin =
    R"text(// Writes a run, a line a step, with the place that printed it; zstep reads it.)text"
    R"text( Depths may be Infinity. For Node: where
// a package is of type "module", call this file .cjs. exports.on = false: nothing is written.
const { relative } = require("path");
const numbers = { Infinity: "inf", "-Infinity": "-inf", NaN: "nan" };
const places = new Map();
let lines = "";

exports.on = true;
exports.flush = () => { process.stdout.write(lines); lines = ""; };
process.on("exit", () => exports.flush());

function place(stack) {  // "    at draw (/home/ada/zbuffer.js:41:7)"
  const found = /\(?(?:file:\/\/)?([^()\s]+):(\d+):\d+\)?$/.exec((stack.split("\n")[3] || "").replace(/^\s*at /, ""));
  const near = found ? relative(process.cwd(), found[1]) : "";
  return found ? (near.startsWith("..") ? near.split(/[\\/]/).pop() : near) + ":" + found[2] : undefined;
}

function step(name, fields) {
  if (!exports.on) return;
  const most = Error.stackTraceLimit;
  Error.stackTraceLimit = 3;
  const stack = new Error().stack || "";
  Error.stackTraceLimit = most;
  if (!places.has(stack)) places.set(stack, place(stack));
  lines += JSON.stringify({ step: name, ...fields, at: places.get(stack) }, (key, value) =>
    typeof value === "number" && !Number.isFinite(value) ? numbers[value] : value) + "\n";
  if (lines.length > 65536) exports.flush();
}

)text";
const std::string_view javascript_header =
    R"text(
const text = [$header].join("");
// The first line of the run: the text of this file, or else the header that was given when this file was made.
exports.header = (file) => {
  if (!exports.on) return;
  if (file === undefined && !text) throw new Error("name the header's file;)text"
    R"text( zstep header SCENE -o head.jsonl makes one");
  lines += (file === undefined ? text : require("fs").readFileSync(file, "utf8")).trimEnd() + "\n";
};
)text";

const std::string_view java_begin =
    R"text(/** Writes a run, a line a step, with the place that printed it; zstep reads it.)text"
    R"text( Depths may be infinite. Java 9. */
final class $Name {
  private $Name() {}

  /** False: nothing is written. */
  static boolean on = true;
  private static final StackWalker walker = StackWalker.getInstance();
  private static final StringBuilder lines = new StringBuilder();
  static { Runtime.getRuntime().addShutdownHook(new Thread($Name::flush)); }

  static synchronized void flush() {
    System.out.print(lines);
    System.out.flush();
    lines.setLength(0);
  }
  private static String text(Object value) {
    if (value instanceof String) return "\"" + ((String) value).replace("\\", "\\\\").replace("\"", "\\\"") + "\"";
    if (!(value instanceof Double)) return value.toString();
    double real = (Double) value;
    if (Double.isNaN(real)) return "\"nan\"";
    return Double.isInfinite(real) ? (real > 0 ? "\"inf\"" : "\"-inf\"") : value.toString();
  }
  private static synchronized void step(String name, Object... fields) {
    if (!on) return;
    lines.append("{\"step\":\"" + name + "\"");
    for (int i = 0; i < fields.length; i += 2) lines.append(",\"" + fields[i] + "\":" + text(fields[i + 1]));
    walker.walk(frames -> frames.skip(2).findFirst())
        .ifPresent(at -> lines.append(",\"at\":" + text(at.getFileName() + ":" + at.getLineNumber())));
    lines.append("}\n");
    if (lines.length() > 65536) flush();
  }

)text";
const std::string_view java_header =
    R"text(
  /** The first line of the run: the text of this file. */
  static synchronized void header(String file) throws java.io.IOException {
    if (on) lines.append(new String(java.nio.file.Files.readAllBytes(java.nio.file.Paths.get(file)),
                                    java.nio.charset.StandardCharsets.UTF_8).trim() + "\n");
  }
)text";
const std::string_view java_header_given =
    R"text(  /** The same of the header that was given when this file was made. */
  static synchronized void header() {
    if (on) lines.append(String.join("", new String[] {$header}) + "\n");
  }
)text";

const std::string_view rust_begin =
    R"text(//! Writes a run, a line a step, with the place that printed it; zstep reads it. Depths may be infinite.
//! Compiled with $NAME_OFF in the environment each call is empty.
#![allow(dead_code)]
use std::cell::RefCell;
use std::io::Write;
use std::panic::Location;

pub const ON: bool = option_env!("$NAME_OFF").is_none();

struct Lines(Vec<u8>);
impl Lines {
    fn flush(&mut self) {
        let mut out = std::io::stdout();
        let _ = out.write_all(&self.0).and_then(|_| out.flush());
        self.0.clear();
    }
}
impl Drop for Lines {
    fn drop(&mut self) {
        self.flush();
    }
}
thread_local! { static LINES: RefCell<Lines> = RefCell::new(Lines(Vec::new())); }

/// Writes what is kept in memory: at the end of a thread that is done by itself.
pub fn flush() {
    LINES.with(|lines| lines.borrow_mut().flush());
}
fn put(line: &str) {
    LINES.with(|lines| {
        let mut lines = lines.borrow_mut();
        lines.0.extend_from_slice(line.as_bytes());
        if lines.0.len() > 65536 {
            lines.flush();
        }
    });
}

enum Value<'a> {
    Whole(i32),
    Real(f64),
    Truth(bool),
    Word(&'a str),
}
impl Value<'_> {
    fn text(&self) -> String {
        match *self {
            Value::Whole(value) => value.to_string(),
            Value::Truth(value) => value.to_string(),
            Value::Word(value) => format!("\"{}\"", value.replace('\\', "\\\\").replace('"', "\\\"")),
            Value::Real(value) if value.is_finite() => format!("{:?}", value),
            Value::Real(value) if value.is_nan() => "\"nan\"".to_string(),
            Value::Real(value) => if value > 0.0 { "\"inf\"" } else { "\"-inf\"" }.to_string(),
        }
    }
}

#[track_caller]
fn step(name: &str, fields: &[(&str, Value)]) {
    if !ON {
        return;
    }
    let at = Location::caller();
    let mut line = format!("{{\"step\":\"{}\"", name);
    for (key, value) in fields {
        line += &format!(",\"{}\":{}", key, value.text());
    }
    let place = format!("{}:{}", at.file(), at.line());
    put(&format!("{},\"at\":{}}}\n", line, Value::Word(&place).text()));
}

)text";
const std::string_view rust_header =
    R"text(
/// The first line of the run: the text of this file.
pub fn header(file: &str) {
    if ON {
        let text = std::fs::read_to_string(file)
            .unwrap_or_else(|error| panic!("{file}: {error}; zstep header SCENE -o head.jsonl makes one"));
        put(&format!("{}\n", text.trim_end()));
    }
}
)text";
const std::string_view rust_header_given =
    R"text(/// The same of the header that was given when this file was made.
pub fn header_given() {
    if ON {
        put(&format!("{}\n", [$header].concat()));
    }
}
)text";

}  // namespace zstep::homework::emitter_texts
