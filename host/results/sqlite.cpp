// SPDX-License-Identifier: MIT
#include "host/results/sqlite.hpp"

#include <sqlite3.h>

#include <cmath>

#include "host/errors/machine_error.hpp"
#include "host/files/network_file_system.hpp"

namespace dmrp::host {
namespace {

// The wrapper is written by hand: it covers the few calls of the C API that are used here.

[[noreturn]] void fail(int code, const std::string& line) {
  switch (code & 0xff) {  // the primary code
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_NOMEM:
      throw MachineError(line);
    case SQLITE_BUSY:
      throw SqliteError(line + " (a dmrp-host that runs writes to it)");
    default:
      throw SqliteError(line);
  }
}

// Throws the connection's last message with the file's name.
[[noreturn]] void fail(sqlite3* connection, const std::string& what) {
  const char* const file = sqlite3_db_filename(connection, "main");
  fail(sqlite3_errcode(connection), std::string(file ? file : "") + ": " + what + ": " + sqlite3_errmsg(connection));
}

// A finished database is read from a network file system without locks and shared memory, which may not work there. What
// a killed run left in its log would be overlooked.
std::string immutable_uri(const std::filesystem::path& path) {
  std::error_code error;
  if (const auto size = std::filesystem::file_size(path.string() + "-wal", error); !error && size > 0)
    throw SqliteError(path.string() + ": was not closed, and cannot be recovered on a network file system (" +
                      network_file_system(path) + "): copy its folder to a disk of this machine");
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '%' || c == '?' || c == '#')
      uri += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
    else
      uri += c;
  }
  return uri + "?immutable=1";
}

}  // namespace

void SqliteConnection::Close::operator()(sqlite3* handle) const {
  sqlite3_close_v2(handle);
}

SqliteConnection::SqliteConnection(const std::filesystem::path& path, SqliteMode mode) {
  if (mode == SqliteMode::create && std::filesystem::exists(path))
    throw SqliteError(path.string() + ": already exists");
  const int flags = mode == SqliteMode::create       ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE
                    : mode == SqliteMode::read_write ? SQLITE_OPEN_READWRITE
                                                     : SQLITE_OPEN_READONLY;
  const bool immutable = mode == SqliteMode::read_only && !network_file_system(path).empty();
  const std::string name = immutable ? immutable_uri(path) : path.string();
  sqlite3* connection = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &connection, flags | (immutable ? SQLITE_OPEN_URI : 0), nullptr);
  handle_.reset(connection);
  if (code != SQLITE_OK) fail(code, path.string() + ": " + sqlite3_errstr(code));
  sqlite3_extended_result_codes(connection, 1);
  sqlite3_busy_timeout(connection, 10'000);
  // as SQLite's guide "Defense Against The Dark Arts" says of files from strangers
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  execute("PRAGMA cell_size_check = ON");
  execute("PRAGMA mmap_size = 0");
}

bool SqliteConnection::has_moved() const {
  int moved = 0;
  return sqlite3_file_control(handle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK && moved != 0;
}

std::string SqliteConnection::file() const {
  const char* const name = sqlite3_db_filename(handle(), "main");
  return name ? name : "";
}

void SqliteConnection::execute(const std::string& sql) {
  if (sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(handle(), sql);
}

void SqliteStatement::Finalize::operator()(sqlite3_stmt* handle) const {
  sqlite3_finalize(handle);
}

SqliteStatement::SqliteStatement(const SqliteConnection& connection, std::string_view sql) {
  sqlite3_stmt* handle = nullptr;
  const int code = sqlite3_prepare_v3(connection.handle(), sql.data(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &handle, nullptr);
  if (code != SQLITE_OK) fail(connection.handle(), std::string(sql));
  handle_.reset(handle);
}

void SqliteStatement::check(int code) {
  if (code != SQLITE_OK) fail(sqlite3_db_handle(handle_.get()), sqlite3_sql(handle_.get()));
}

SqliteStatement& SqliteStatement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), next_parameter_++, value));
  return *this;
}

SqliteStatement& SqliteStatement::bind(double value) {
  if (std::isnan(value)) return bind_null();
  check(sqlite3_bind_double(handle_.get(), next_parameter_++, value));
  return *this;
}

SqliteStatement& SqliteStatement::bind(std::string_view value) {
  const char* data = value.data() ? value.data() : "";  // SQLite binds a null pointer as NULL
  check(sqlite3_bind_text64(handle_.get(), next_parameter_++, data, value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

SqliteStatement& SqliteStatement::bind_null() {
  check(sqlite3_bind_null(handle_.get(), next_parameter_++));
  return *this;
}

bool SqliteStatement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) fail(sqlite3_db_handle(handle_.get()), sqlite3_sql(handle_.get()));
  reset();
  return false;
}

void SqliteStatement::run() {
  while (step()) {
  }
}

void SqliteStatement::reset() {
  sqlite3_reset(handle_.get());  // returns the code of the last step again
  next_parameter_ = 1;
}

bool SqliteStatement::column_is_null(int column) const {
  return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL;
}

std::int64_t SqliteStatement::column_integer(int column) const {
  return sqlite3_column_int64(handle_.get(), column);
}

double SqliteStatement::column_number(int column) const {
  return sqlite3_column_double(handle_.get(), column);
}

std::string SqliteStatement::column_text(int column) const {
  const unsigned char* text = sqlite3_column_text(handle_.get(), column);
  if (!text) return {};
  return {reinterpret_cast<const char*>(text), static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

SqliteTransaction::SqliteTransaction(SqliteConnection& connection) : connection_(connection) {
  connection_.execute("BEGIN IMMEDIATE");
}

SqliteTransaction::~SqliteTransaction() {
  if (open_) sqlite3_exec(connection_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void SqliteTransaction::commit() {
  connection_.execute("COMMIT");
  open_ = false;
}

}  // namespace dmrp::host
