// SPDX-License-Identifier: MIT
// sqlite.hpp: RAII handles for SQLite, with errors as exceptions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace dmrp::host {

class SqliteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// create: the file must not exist. create and read_write: no other process can open the file until this connection closes,
// and its index of the log is in memory of this process.
enum class SqliteMode { create, read_write, read_only };

class SqliteConnection {
 public:
  SqliteConnection(const std::filesystem::path& path, SqliteMode mode);

  // Runs statements that return no rows.
  void execute(const std::string& sql);

  // Whether the file was deleted or renamed: what is written is lost.
  bool has_moved() const;

  std::string file() const;

  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

// A prepared statement; parameters and columns count from 0. To read rows:
//   while (statement.step()) use(statement.column_text(0));
class SqliteStatement {
 public:
  SqliteStatement(const SqliteConnection& connection, std::string_view sql);

  // Binds the next parameter, starting with the first after run() or reset(). Binds NaN as NULL.
  SqliteStatement& bind(std::int64_t value);
  SqliteStatement& bind(double value);
  SqliteStatement& bind(std::string_view value);
  SqliteStatement& bind_null();

  bool step();   // true: there is a row. After the last row the statement is reset
  void run();    // steps to the end
  void reset();  // needed if step() did not reach the end

  bool column_is_null(int column) const;
  std::int64_t column_integer(int column) const;
  double column_number(int column) const;
  std::string column_text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const;
  };

  void check(int code);

  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  int next_parameter_ = 1;
};

// Rolls back unless committed.
class SqliteTransaction {
 public:
  explicit SqliteTransaction(SqliteConnection& connection);
  ~SqliteTransaction();
  SqliteTransaction(const SqliteTransaction&) = delete;
  SqliteTransaction& operator=(const SqliteTransaction&) = delete;

  void commit();

 private:
  SqliteConnection& connection_;
  bool open_ = true;
};

}  // namespace dmrp::host
