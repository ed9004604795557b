// The material of a scene: defaults, every model, messages for wrong values.

#include <impoint/base/parameter_file.h>
#include <impoint/materials/elastoplastic.h>
#include <impoint/materials/hencky.h>
#include <impoint/materials/linear_elastic.h>
#include <impoint/materials/models.h>
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

// the tables know each other's names, and no others
void check_tables()
{
  std::string unknown;
  for (const Model &row : models())
    for (const std::string &name : row.entries)
      {
        bool found = false;
        for (const ModelEntry &entry : model_entries())
          found |= entry.name == name;
        if (!found)
          unknown += " " + name;
      }
  for (const ModelEntry &entry : model_entries())
    if (entry.models().empty())
      unknown += " " + entry.name;
  std::cout << "entries without a row or model:" << unknown << '\n';
  try
    {
      model("rubber");
      std::cout << "a model nobody wrote is " << model("rubber").name << '\n';
    }
  catch (const ExceptionBase &)
    {
      std::cout << "a model nobody wrote is refused\n";
    }
}

int main()
{
  check_tables();
  check<LinearElastic>("linear elastic");
  check<StVenantKirchhoff>("St. Venant-Kirchhoff");
  check<NeoHookean>("neo-Hookean");
  check<Hencky>("Hencky");

  // the same step yields by different amounts
  const auto plastic = [](const std::string              &name,
                          const std::vector<std::string> &entries) {
    std::vector<std::string> all = entries;
    all.insert(all.end(), {"Model = " + name, "Young's modulus = 1e3"});
    const auto          created = create(all);
    std::vector<double> history(created->n_history(), 0.), after(history);
    Deformation<2>      bar;
    bar.grad_increment[0][0] = 0.5;
    bar.grad_increment[1][1] = -0.5;
    Response<2> response;
    created->respond(bar, history.data(), after.data(), true, response);
    std::cout << name << ": stress = " << response.stress[1]
              << (created->symmetric_tangent() ? ", associated\n" : "\n");
  };
  plastic("Mohr-Coulomb", {"Friction angle = 30"});
  plastic("Mohr-Coulomb",
          {"Friction angle = 30", "Cohesion = 50", "Dilation angle = 30"});
  plastic("Drucker-Prager", {"Friction angle = 30"});
  plastic("von Mises", {"Yield stress = 90"});

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
  refuse({"Young's modulus = 1", "Cohesion = 5"});
  refuse({"Young's modulus = 1", "Model = Mohr-Coulomb"});
  refuse({"Young's modulus = 1",
          "Model = Mohr-Coulomb",
          "Friction angle = 20",
          "Dilation angle = 25"});
  refuse({"Young's modulus = 1", "Model = von Mises"});
  refuse({"Young's modulus = 1",
          "Model = von Mises",
          "Yield stress = 1",
          "Softening residual = 0.5"});
}
