// The material of a scene: defaults, every model, messages for wrong values.

#include <impoint/base/parameter_file.h>
#include <impoint/materials/hencky.h>
#include <impoint/materials/linear_elastic.h>
#include <impoint/materials/neo_hookean.h>
#include <impoint/materials/st_venant_kirchhoff.h>

#include <iostream>

using namespace Impoint;
using namespace Impoint::Materials;

const std::string section = "Bodies/beam/Material";

std::unique_ptr<Material<2>> create(std::vector<std::string> overrides)
{
  for (std::string &text : overrides)
    text = section + "/" + text;
  ParameterFile file("", overrides);
  declare_parameters(file, section);
  file.apply();
  return create_material<2>(file, section);
}

// tau_11 of a bar stretched by 1.5 tells the models and moduli apart
template <template <int> class Model>
void check(const std::string &name)
{
  const auto created = create(
    {"Model = " + name, "Young's modulus = 1e3", "Poisson's ratio = 0.25"});
  Deformation<2> bar;
  bar.F[0][0]              = 1;
  bar.F[1][1]              = 1.5;
  bar.grad_increment[1][1] = 0.5;
  Response<2> response;
  created->respond(bar, nullptr, nullptr, true, response);
  std::cout << name << ": E = " << created->young()
            << ", stress = " << response.stress[1] << ", "
            << (dynamic_cast<Model<2> *>(created.get()) ? "its own" : "wrong")
            << " class\n";
}

void refuse(const std::vector<std::string> &overrides)
{
  try
    {
      create(overrides);
      std::cout << "accepted\n";
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << '\n';
    }
}

int main()
{
  check<LinearElastic>("linear elastic");
  check<StVenantKirchhoff>("St. Venant-Kirchhoff");
  check<NeoHookean>("neo-Hookean");
  check<Hencky>("Hencky");

  const auto by_default = create({"Young's modulus = 1"});
  std::cout << "default: " << (by_default->small_strain() ? "small" : "finite")
            << " strains\n";

  refuse({});
  refuse({"Young's modulus = 0"});
  refuse({"Young's modulus = -5"});
  refuse({"Young's modulus = 1", "Poisson's ratio = 0.5"});
  refuse({"Young's modulus = 1", "Poisson's ratio = -1"});
  refuse({"Young's modulus = 1", "Poisson's ratio = 0.6"});
  refuse({"Young's modulus = 1", "Model = rubber"});
}
