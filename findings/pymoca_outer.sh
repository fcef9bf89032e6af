#!/usr/bin/env bash
# pymoca 0.12.0: a body on the Moon falls as on Earth: an outer component of a Modelica model is one of its own, with the values of its class.
#
# In Modelica a component that is declared outer is not a component but a reference to the inner one of the same name further up; the multibody
# library hands gravity to every body in this way. pymoca reads both words and flattens an outer World as a further World. The gravity of the
# inner one is 1.62 and nothing depends on it; that of the body is a parameter world.g of the body, at the 9.81 of the class. In
# the same way a component with a condition, damper if damped, is there with its equations whether the condition is true or false. The
# model is translated to CasADi without a word about either.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pymoca==0.12.0 casadi==3.8.2 setuptools==80.9.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import casadi
import pymoca.backends.casadi.generator
import pymoca.parser

MODEL = """
model World
  parameter Real g = 9.81;
end World;
model Damper
  parameter Real d = 5;
  Real force;
  Real speed;
equation
  force = d * speed;
  speed = 2;
end Damper;
model Body
  outer World world;
  parameter Real m = 1;
  Real weight;
equation
  weight = m * world.g;
end Body;
model Moon
  inner World world(g = 1.62);
  parameter Boolean damped = false;
  Body body(m = 2);
  Damper damper if damped;
end Moon;
"""
model = pymoca.backends.casadi.generator.generate(pymoca.parser.parse(MODEL), "Moon")
parameters = {parameter.symbol.name(): parameter for parameter in model.parameters}
values = {name: float(parameter.value) for name, parameter in parameters.items() if name != "damped"}
unknowns = [state.symbol for state in model.alg_states]
names = sorted(symbol.name() for symbol in unknowns)
jacobian = casadi.Function("jacobian", [parameter.symbol for parameter in parameters.values()] + unknowns,
                           [casadi.jacobian(casadi.vertcat(*model.equations), parameters["world.g"].symbol)])
print("pymoca", importlib.metadata.version("pymoca"))
print("parameters:", values)
print("unknowns:", names, "with", len(model.equations), "equations")
print("equations:", *(str(equation) for equation in model.equations))
print("equations that depend on the inner world's g:", jacobian.nnz_out(0))
sys.exit(not (values["world.g"] == 1.62 and values["body.world.g"] == 9.81 and values["body.m"] == 2 and jacobian.nnz_out(0) == 0
              and names == ["body.weight", "damper.force", "damper.speed"] and len(model.equations) == 3))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
