# SPDX-License-Identifier: LGPL-2.1-or-later
"""Evaluates the expressions of cases, such as `z - max(0, 1 - x/8)`, for arrays."""

import ast
import re

import numpy as np

_FUNCTIONS = {name: getattr(np, name) for name in ("sqrt", "abs", "exp", "log", "log10", "log2", "sin", "cos", "tan", "sinh", "cosh", "tanh", "sign", "rint", "floor", "ceil")}
_FUNCTIONS |= {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2, "ln": np.log, "pow": np.power, "where": np.where,
               "min": lambda *values: np.minimum.reduce(np.broadcast_arrays(*values)),
               "max": lambda *values: np.maximum.reduce(np.broadcast_arrays(*values))}
_CONSTANTS = {"pi": np.pi, "Pi": np.pi, "_pi": np.pi, "_e": np.e}
_BINARY = {ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide, ast.Pow: np.power}
_COMPARISONS = {ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater, ast.GtE: np.greater_equal, ast.Eq: np.equal, ast.NotEq: np.not_equal}


def evaluate(text, **variables):
    """The value of an expression in the syntax of muParser. Throws a ValueError at what it cannot evaluate, such as `a ? b : c`."""
    python = re.sub(r"\bif\s*\(", "where(", text.replace("^", "**").replace("&&", " and ").replace("||", " or ")).strip()
    try:
        return _value(ast.parse(python, mode="eval").body, variables)
    except (SyntaxError, TypeError) as error:
        raise ValueError(f"the expression {text} cannot be evaluated: {error}") from error


def _value(node, variables):
    def of(part):
        return _value(part, variables)

    match node:
        case ast.Constant(value=float() | int() as number):
            return float(number)
        case ast.Name(id=name) if name in variables:
            return variables[name]
        case ast.Name(id=name) if name in _CONSTANTS:
            return _CONSTANTS[name]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return np.negative(of(operand))
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return of(operand)
        case ast.BinOp(left=left, op=operator, right=right) if type(operator) in _BINARY:
            return _BINARY[type(operator)](of(left), of(right))
        case ast.BoolOp(op=operator, values=values):
            combine = np.logical_and if isinstance(operator, ast.And) else np.logical_or
            return combine.reduce(np.broadcast_arrays(*map(of, values)))
        case ast.Compare(left=left, ops=[operator], comparators=[right]) if type(operator) in _COMPARISONS:
            return _COMPARISONS[type(operator)](of(left), of(right))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in _FUNCTIONS:
            return _FUNCTIONS[name](*map(of, arguments))
    raise ValueError(f"{ast.unparse(node)} is not supported")
