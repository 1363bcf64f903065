"""A JSON Schema (draft 7, what 'ifov schema' prints): what a value is by it, and whether it is valid."""

import math
import re

TYPES = {
    "object": lambda value: isinstance(value, dict),
    "array": lambda value: isinstance(value, list),
    "string": lambda value: isinstance(value, str),
    "boolean": lambda value: isinstance(value, bool),
    "number": lambda value: isinstance(value, (int, float)) and not isinstance(value, bool),
    "integer": lambda value: isinstance(value, (int, float)) and not isinstance(value, bool)
    and (isinstance(value, int) or (math.isfinite(value) and value == int(value))),
    "null": lambda value: value is None,
}

LIMITS = {
    "minimum": lambda value, limit: value >= limit,
    "maximum": lambda value, limit: value <= limit,
    "exclusiveMinimum": lambda value, limit: value > limit,
    "exclusiveMaximum": lambda value, limit: value < limit,
}

# What a schema may say without a say in which values are good.
REMARKS = {"description", "default", "deprecated", "definitions", "$schema", "title", "if", "else"}


class Schema:
    def __init__(self, content):
        self.definitions = content["definitions"]
        self.root = self.definitions["document"]
        self.names = {id(node): name for name, node in self.definitions.items()}

    def resolved(self, node):
        """The node that references, and remarks beside a node, lead to."""
        while True:
            if "$ref" in node:
                node = self.definitions[node["$ref"].rsplit("/", 1)[-1]]
            elif "type" not in node and "properties" not in node and len(node.get("allOf", ())) == 1:
                node = node["allOf"][0]
            else:
                return node

    def alternatives(self, node):
        """The nodes of which a value is one, those of nested choices among them."""
        node = self.resolved(node)
        if "anyOf" not in node:
            return [node]
        return [leaf for choice in node["anyOf"] for leaf in self.alternatives(choice)]

    def alternative_of(self, value, node):
        """The alternative that a value is, or most likely is meant to be."""
        choices = self.alternatives(node)
        if len(choices) == 1:
            return choices[0]
        valid = [choice for choice in choices if self.valid(value, choice)]
        alike = [choice for choice in choices if TYPES[choice.get("type", "string")](value)]
        if not valid and isinstance(value, dict):
            alike.sort(key=lambda choice: -len(value.keys() & choice.get("properties", {}).keys()))
        return (valid or alike or choices)[0]

    def definition_name(self, node):
        return self.names.get(id(node))

    def child(self, node, key):
        """The node of a key or an item of a container, None where the schema knows none."""
        if isinstance(key, int):
            return node.get("items")
        return node.get("properties", {}).get(key) or node.get("additionalProperties") or None

    def places(self, value, node, description=""):
        """Every value within, as (container, its definition's name, key, node, description that applies to it)."""
        node = self.alternative_of(value, node)
        name = self.definition_name(node)
        keys = list(value) if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
        for key in keys:
            child = self.child(node, key)
            if child:
                said = child.get("description", description)
                yield value, name, key, child, said
                yield from self.places(value[key], child, said)

    def valid(self, value, node):
        node = self.resolved(node)
        return all(CHECKS[word](self, value, node) for word in node if word not in REMARKS)


def _additional(schema, value, node):
    rest = [item for key, item in value.items() if key not in node.get("properties", {})]
    allowed = node["additionalProperties"]
    return not rest if allowed is False else all(schema.valid(item, allowed) for item in rest)


def _if(kind, check):
    """Words about one type say nothing of values of another."""
    return lambda schema, value, node: not TYPES[kind](value) or check(schema, value, node)


def _limit(word):
    return _if("number", lambda schema, value, node: LIMITS[word](value, node[word]))


CHECKS = {
    "$ref": lambda schema, value, node: True,  # followed before
    "type": lambda schema, value, node: TYPES[node["type"]](value),
    "enum": lambda schema, value, node: value in node["enum"],
    "pattern": _if("string", lambda schema, value, node: re.search(node["pattern"], value) is not None),
    "required": _if("object", lambda schema, value, node: all(key in value for key in node["required"])),
    "properties": _if("object", lambda schema, value, node: all(
        schema.valid(value[key], child) for key, child in node["properties"].items() if key in value)),
    "additionalProperties": _if("object", _additional),
    "propertyNames": _if("object", lambda schema, value, node: all(
        schema.valid(key, node["propertyNames"]) for key in value)),
    "maxProperties": _if("object", lambda schema, value, node: len(value) <= node["maxProperties"]),
    "dependencies": _if("object", lambda schema, value, node: all(
        other in value for key, others in node["dependencies"].items() if key in value for other in others)),
    "items": _if("array", lambda schema, value, node: all(schema.valid(item, node["items"]) for item in value)),
    "minItems": _if("array", lambda schema, value, node: len(value) >= node["minItems"]),
    "maxItems": _if("array", lambda schema, value, node: len(value) <= node["maxItems"]),
    "anyOf": lambda schema, value, node: any(schema.valid(value, one) for one in node["anyOf"]),
    "allOf": lambda schema, value, node: all(schema.valid(value, one) for one in node["allOf"]),
    "oneOf": lambda schema, value, node: sum(schema.valid(value, one) for one in node["oneOf"]) == 1,
    "not": lambda schema, value, node: not schema.valid(value, node["not"]),
    **{word: _limit(word) for word in LIMITS},
}
