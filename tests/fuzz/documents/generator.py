"""Makes documents that are valid, or nearly, by the schema: from seeds that are changed and crossed, and from nothing.

A document depends on the seed and its number alone."""

import copy
import random as random_numbers
import re

import values
from writing import written

# Of strings that name something, what they name and where in the document it is given a name.
NAMED = {
    "material": lambda document: list(_at(document, "scene", "materials")),
    "prototype": lambda document: list(_at(document, "scene", "prototypes")),
    "channel": lambda document: _names(_at(document, "sensor", "channels")),
    "object": lambda document: _names(_at(document, "scene", "objects")),
}
FILE_PATTERN = "^[^\\u0000]+$"
ODD = (None, {}, [], "", True, 0, -1, "x", [[]], {"": {}}, [None], "z" * 100_000)
MOST_CHARACTERS = 300_000
WILDNESS = (0.0, 0.0, 0.02, 0.1, 0.4)


def _at(document, *keys):
    for key in keys:
        document = document.get(key) if isinstance(document, dict) else None
    return document if isinstance(document, (dict, list)) else []


def _names(items):
    return [item["name"] for item in items if isinstance(item, dict) and isinstance(item.get("name"), str)]


class Generator:
    """`seeds`: good documents; `files`: for a definition of the schema and a key in it, names of files to choose from."""

    def __init__(self, schema, seeds, files):
        self.schema, self.seeds, self.files = schema, seeds, files
        self.grafts = {}
        for seed in seeds:
            for container, _, key, node, _ in schema.places(seed, schema.root):
                name = schema.definition_name(schema.alternative_of(container[key], node))
                if name:
                    self.grafts.setdefault(name, []).append(container[key])

    def document(self, seed, number):
        self.random = random_numbers.Random(f"{seed}.{number}")
        self.wildness = self.random.choice(WILDNESS)
        document = self.make(self.schema.root) if self.random.random() < 0.2 else None
        if document is None or len(written(document)) > MOST_CHARACTERS:
            document = copy.deepcopy(self.random.choice(self.seeds))
        for _ in range(self.random.choice((0, 1, 1, 2, 3, 5, 8))):
            before = copy.deepcopy(document)
            if document:
                self.change(document)
            if len(written(document)) > MOST_CHARACTERS:
                document = before
        self.name_what_is_there(document)
        return document

    # By the schema alone.

    def make(self, node, description="", key=None, parent=None, depth=0):
        description = node.get("description", description)
        node = self.random.choice(self.schema.alternatives(node))
        if "enum" in node:
            return self.random.choice(node["enum"])
        return getattr(self, "make_" + node["type"])(node, description, key, parent, depth)

    def make_object(self, node, description, key, parent, depth):
        name = self.schema.definition_name(node)
        table = (name or "").startswith("table_of")
        if name in self.grafts and depth > 0 and self.random.random() < (0.8 if table else 0.3):
            return copy.deepcopy(self.random.choice(self.grafts[name]))
        if isinstance(node.get("additionalProperties"), dict):
            names = self.random.sample(values.NAMES, self.random.randint(1, 3))
            if "propertyNames" in node:
                names = [values.text(self.random, node["propertyNames"]["pattern"], None, 0) if "0-9" in
                         node["propertyNames"]["pattern"] else one for one in names]
            return {one: self.make(node["additionalProperties"], description, one, name, depth + 1) for one in names}
        made = {}
        for one in self.chosen_keys(node, depth):
            made[one] = self.make(node["properties"][one], description, one, name, depth + 1)
        return made

    def chosen_keys(self, node, depth):
        """Keys of an object: those required, one of each group that excludes each other, and some more."""
        keys = set(node.get("required", ()))
        grouped = set()
        for group in (one["oneOf"] for one in node.get("allOf", ()) if "oneOf" in one):
            grouped.update(key for choice in group for key in choice.get("required", ()))
            keys.update(self.random.choice(self.present(node, group)).get("required", ()))
        for key in node.get("properties", ()):
            if key not in grouped and self.random.random() < (0.5 if depth == 0 else 0.25):
                keys.add(key)
        for key in sorted(keys):
            keys.update(node.get("dependencies", {}).get(key, ()))
        if grouped and self.random.random() < 0.3 * self.wildness:
            keys.add(self.random.choice(sorted(grouped)))
        return [key for key in node.get("properties", ()) if key in keys and not self.is_former(node, key)]

    def present(self, node, group):
        """The cases of a group whose keys are not earlier names of others."""
        return [one for one in group if not any("deprecated" in node["properties"][key] for key in one.get("required", ()))]

    def is_former(self, node, key):
        """Whether a key is an earlier name of another, which now and then is used all the same."""
        return "deprecated" in node["properties"][key] and self.random.random() > 0.1 * self.wildness

    def make_array(self, node, description, key, parent, depth):
        least, most = node.get("minItems", 0), node.get("maxItems", 5)
        count = min(most, least + self.random.choice((0, 0, 1, 2, 3)))
        if self.random.random() < self.wildness:
            count = self.random.choice((0, max(0, least - 1), min(most + 1, 2000)))
        items = [self.make(node["items"], description, key, parent, depth + 1) for _ in range(min(count, 6))]
        return [items[i % len(items)] for i in range(count)] if items else []

    def make_string(self, node, description, key, parent, depth):
        pattern = node.get("pattern")
        if pattern is None:
            return self.random.choice(values.NAMES)  # of something: name_what_is_there chooses
        if pattern == FILE_PATTERN:
            return self.random.choice(self.files(parent, key))
        units = values.units_of(pattern)
        if units:
            return values.quantity(self.random, pattern, units, description, self.wildness)
        made = values.text(self.random, pattern, key, self.wildness)
        if made is None:
            raise ValueError(f"the fuzzer of documents has no texts for the pattern {pattern} (values.py)")
        return made

    def make_number(self, node, description, key, parent, depth):
        return values.number(self.random, node, self.wildness)

    make_integer = make_number

    def make_boolean(self, node, description, key, parent, depth):
        return self.random.random() < 0.5

    # Changes to what is there.

    def change(self, document):
        """One change at a place of the document; containers have as good a chance as what is in them."""
        container, key, node, description, parent = self.place(document)
        name = self.schema.definition_name(self.schema.alternative_of(container[key], node))
        value, chance = container[key], self.random.random()
        if chance < 0.01 + 0.1 * self.wildness:
            container[key] = copy.deepcopy(self.random.choice(ODD))
        elif chance < 0.2 and name in self.grafts:
            container[key] = copy.deepcopy(self.random.choice(self.grafts[name]))
        elif chance < 0.5 and isinstance(value, list) and value:
            before = list(value)
            self.change_list(value)
            if not self.schema.valid(value, node) and self.random.random() > 0.1 + self.wildness:
                value[:] = before
        elif chance < 0.55:
            if self.random.random() < 0.1 or self.optional(container, key, parent):
                del container[key]
        elif chance < 0.8 and isinstance(value, dict):
            self.add_key(value, node)
        else:
            wildness, self.wildness = self.wildness, max(self.wildness, self.random.choice((0, 0.5)))
            container[key] = self.make(node, description, key, parent, 1)
            self.wildness = wildness

    def optional(self, container, key, parent):
        """True where a container is as good without the key; items of lists are for change_list."""
        if isinstance(container, list):
            return False
        node = self.schema.definitions.get(parent, {})
        needed = [node.get("required", ())]
        needed += [choice.get("required", ()) for one in node.get("allOf", ()) for choice in one.get("oneOf", ())]
        needed += [others for other, others in node.get("dependencies", {}).items() if other in container]
        return not any(key in keys for keys in needed)

    def place(self, document):
        container, node, description = document, self.schema.root, ""
        while True:
            node = self.schema.alternative_of(container, node)
            parent = self.schema.definition_name(node)
            keys = [key for key in (container if isinstance(container, dict) else range(len(container)))
                    if self.schema.child(node, key)]
            key = self.random.choices(keys, [self.weight(container[one], self.schema.child(node, one)) for one in keys])[0]
            child = self.schema.child(node, key)
            description = child.get("description", description)
            value = container[key]
            inner = isinstance(value, (dict, list)) and any(
                self.schema.child(self.schema.alternative_of(value, child), one)
                for one in (value if isinstance(value, dict) else range(len(value))))
            # As many values as wavelengths, which rise: a spectrum is changed as a whole, else few would be taken.
            table = (self.schema.definition_name(self.schema.resolved(child)) or "").startswith("table_of")
            if not inner or self.random.random() < (0.8 if table else 0.15):
                return container, key, child, description, parent
            container, node = value, child

    def weight(self, value, node):
        """How likely a change is there: more where there is more, little where there is but one good value."""
        if isinstance(value, (dict, list)):
            return 4
        node = self.schema.resolved(node)
        return 0.2 if "minimum" in node and node.get("maximum") == node["minimum"] else 1

    def change_list(self, items):
        what = self.random.randrange(5)
        if what == 0:
            items.reverse()
        elif what == 1:
            items.append(copy.deepcopy(self.random.choice(items)))
        elif what == 2:
            del items[self.random.randrange(len(items))]
        elif what == 3 and self.random.random() < 0.3:
            items *= self.random.choice((2, 10, 1000)) if len(items) < 10 else 2
        else:
            items[self.random.randrange(len(items))] = copy.deepcopy(self.random.choice(items))

    def add_key(self, value, node):
        node = self.schema.alternative_of(value, node)
        absent = [key for key in node.get("properties", ()) if key not in value]
        if absent:
            key = self.random.choice(absent)
            group = next((one["oneOf"] for one in node.get("allOf", ()) if "oneOf" in one
                          and any(key in choice.get("required", ()) for choice in one["oneOf"])), ())
            for other in (name for choice in group for name in choice.get("required", ())):
                if self.random.random() > 0.1 * self.wildness:
                    value.pop(other, None)
            for one in (key, *node.get("dependencies", {}).get(key, ())):
                if one not in value:
                    value[one] = self.make(node["properties"][one], "", one, self.schema.definition_name(node), 1)

    def name_what_is_there(self, document):
        """Names of materials and so on lead somewhere, and files are ones that exist, but for a few."""
        if not isinstance(document, dict):
            return
        names = {kind: find(document) for kind, find in NAMED.items()}
        for container, parent, key, node, description in list(self.schema.places(document, self.schema.root)):
            value = container[key]
            if not isinstance(value, str) or self.random.random() < 0.1 * self.wildness:
                continue
            node = self.schema.alternative_of(value, node)
            kind = re.search(r"name of an? (\w+)", description)
            if node.get("pattern") == FILE_PATTERN and not value.startswith("files/"):
                container[key] = self.random.choice(self.files(parent, key))
            elif "pattern" not in node and "enum" not in node and kind and names.get(kind[1]):
                if value not in names[kind[1]]:
                    container[key] = self.random.choice(names[kind[1]])
