// Sets or unsets an environment variable during its lifetime.
#pragma once

#include <stdlib.h>

#include <optional>
#include <string>

namespace gearshift::test {

class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* was = getenv(name)) was_ = was;
    set(value);
  }
  ~Variable() { set(was_ ? was_->c_str() : nullptr); }
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
  std::optional<std::string> was_;
};

}  // namespace gearshift::test
