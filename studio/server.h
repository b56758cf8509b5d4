// What:   the addresses the page asks, and what each answers.
// Source: ours; cpp-httplib speaks HTTP.
// Differs: every connection carries one request, so that nothing left of a refused one is taken for the next.
// Cost:   a thread a connection.
#pragma once

#include <memory>
#include <string>

#include "project/project.h"

namespace inkgrid::studio {

class Server {
 public:
  // Takes the port, 0 for any free one.  Throws Error{usage} where it can't.
  Server(const std::string& host, int port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // A drawing or a project that the page begins with.  Throws Error{file}.
  void open(ImageFile file);

  // With the token of this run.
  std::string address() const;

  // Until the program ends.
  void listen();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace inkgrid::studio
