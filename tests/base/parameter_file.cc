// Scene files: syntax, includes, overrides, what is said about mistakes, the
// template and the parameters used.

#include <impoint/base/parameter_file.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace Impoint;

const double third = 1. / 3.; // needs all 17 digits

// What modules would declare.
struct Parameters
{
  std::string  names, model = "linear", mesh = "none.msh";
  double       modulus    = third;
  unsigned int iterations = 25;

  void declare_body(ParameterFile &file, const std::string &name)
  {
    EntryHandler &prm = file.handler();
    prm.enter_subsection(name);
    prm.add_parameter("Mesh", mesh, "A\nfile.", Patterns::FileName());
    prm.enter_subsection("Material");
    prm.add_parameter("Model",
                      model,
                      "The law.",
                      Patterns::Selection("linear|neo-Hookean"));
    prm.add_parameter("Modulus", modulus, "In Pa.", Patterns::Double(0, 1e12));
    prm.leave_subsection();
    prm.leave_subsection();
    file.declare_as_path("Bodies/" + name + "/Mesh");
  }

  explicit Parameters(ParameterFile &file)
  {
    file.handler().enter_subsection("Bodies");
    file.handler().add_parameter("Names", names, "The bodies.");
    for (const std::string &name : file.names("Bodies/Names"))
      declare_body(file, name);
    file.handler().leave_subsection();
    file.handler().enter_subsection("Newton");
    file.handler().add_parameter("Iterations", iterations, "A step.");
    file.handler().leave_subsection();
    file.apply();
  }
};

void attempt(const std::string              &text,
             const std::vector<std::string> &overrides = {})
{
  std::ofstream("mistake.prm") << text;
  try
    {
      ParameterFile    file("mistake.prm", overrides);
      const Parameters parameters(file);
      std::cout << "no mistake: " << parameters.iterations << std::endl;
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

void mistakes_of_syntax()
{
  std::ofstream("parts/open.prm") << "subsection Newton";
  attempt("subsection Newton\n");
  attempt("\nend");
  attempt("sett Iterations = 3");
  attempt("subsection Newton\n set Iterations 3\nend");
  attempt("subsection Newton\n set Iterations = 3\n set Iterations = 4\nend");
  attempt("include nowhere.prm");
  attempt("# twice\ninclude mistake.prm");
  attempt("include parts/open.prm\nend");
  attempt("", {"Newton/Iterations"});
}

void mistakes_of_content()
{
  const std::string beam =
    "subsection Bodies\n set Names = beam\n subsection beam\n";
  attempt("subsection Newton\n set Iteration = 3\nend");
  attempt("subsection Newten\n set Iterations = 3\nend");
  attempt("", {"Newton/Iterations = -3"});
  attempt("", {"Newton/Iterations = 3", "Newton/Iterations ="});
  attempt("", {"Newton/Iterations = 3", "Newton/Iterations = 4"});
  attempt(beam + "set Modulus = 3\nend\nend");
  attempt(beam + "end\nsubsection plate\nend\nend");
  attempt(beam + "subsection Material\nset Model = neohook\nend\nend\nend");
  // what a file describes that is included may be left out, not misspelt
  std::ofstream("parts/two.prm") << beam + "end\nsubsection plate\nset Mesh = "
                                           "a\nend\nend";
  attempt("include parts/two.prm");
  attempt("include parts/two.prm\nsubsection Bodies\nsubsection plate\n"
          "set Mesh = b\nend\nend");
  std::ofstream("parts/two.prm", std::ios::app) << "\nsubsection Newten\nend";
  attempt("include parts/two.prm");
  attempt("", {"Bodies/Names = beam, b/c"});
  attempt("", {"Bodies/Names = a, a"});
}

void good_scene()
{
  std::ofstream("parts/base.prm") << "subsection Material\nset Modulus = \\\n"
                                     "3e1\nend\nset Mesh = base.msh # here";
  std::ofstream("scene.prm")
    << "subsection Bodies\nset Names = beam, plate\nsubsection beam\n"
       "include parts/base.prm\nsubsection Material\nset Modulus = 4\nend\n"
       "end\nend\n";
  ParameterFile      file("scene.prm", {"Newton / Iterations=7"});
  const Parameters   parameters(file);
  std::ostringstream used, repeated;
  file.print_used(used);
  std::string       text = used.str();
  const std::string here = std::filesystem::current_path().string();
  for (auto found = text.find(here); found != std::string::npos;
       found      = text.find(here))
    text.replace(found, here.size(), "HERE");
  std::cout << text;

  std::ofstream("used.prm") << used.str();
  ParameterFile    again("used.prm", {});
  const Parameters same(again);
  again.print_used(repeated);
  std::cout << "repeats: " << (repeated.str() == used.str())
            << ", exact default: " << (same.modulus == third) << std::endl;

  ParameterFile    empty("", {"Bodies/Names = plate"});
  const Parameters defaults(empty);
  empty.print_template(std::cout);
}

int main()
{
  std::filesystem::create_directory("parts");
  mistakes_of_syntax();
  mistakes_of_content();
  good_scene();
}
