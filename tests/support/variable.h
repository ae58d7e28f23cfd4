// Sets or unsets an environment variable during its lifetime, then restores its old value.
#pragma once

#include <stdlib.h>

#include <optional>
#include <string>

namespace gearshift::test {

class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old_value = getenv(name)) old_value_ = old_value;
    set(value);
  }
  ~Variable() { set(old_value_ ? old_value_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const char* value) const {
    if (value != nullptr)
      setenv(name_, value, 1);
    else
      unsetenv(name_);
  }
  const char* name_;
  std::optional<std::string> old_value_;
};

}  // namespace gearshift::test
