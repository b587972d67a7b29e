#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The manifests of scripts/cluster/kubernetes are jobs of batch/v1, agree with themselves and with the scripts that they
start; and the schema refuses what Kubernetes would refuse. Skipped (77) without python3-jsonschema and python3-yaml."""
import copy
import json
import pathlib
import random
import re
import sys
import unittest

try:
    import jsonschema
    import yaml
except ImportError as missing:
    print(f"skipped: {missing.name} is missing; install python3-jsonschema and python3-yaml")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
MANIFESTS = sorted((ROOT / "scripts/cluster/kubernetes").glob("*.yaml"))
SCHEMA = json.loads((ROOT / "tests/cluster/job_schema.json").read_text())
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)
NUMBERS = dict(re.findall(r"#define FILAMENT_CORE_VERSION_(\w+) (\d+)", (ROOT / "base/include/filament_core/Version.h").read_text()))
IMAGE = f"filament-core:{NUMBERS['MAJOR']}.{NUMBERS['MINOR']}.{NUMBERS['PATCH']}"  # of this version
CONTAINERFILE = (ROOT / "Containerfile").read_text()


class StrictLoader(yaml.SafeLoader):
    """A key that is there twice is an error."""

    def construct_mapping(self, node, deep=False):
        keys = [self.construct_object(key) for key, _ in node.value]
        if len(keys) != len(set(keys)):
            raise yaml.YAMLError(f"a key is there twice: {keys}")
        return super().construct_mapping(node, deep)


def jobs_of(path):
    return list(yaml.load_all(path.read_text(), Loader=StrictLoader))


def places(value, path=()):
    """Every mapping entry and list element below `value`."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in entries:
        yield path + (key,)
        yield from places(inner, path + (key,))


def parent_of(value, path):
    for key in path[:-1]:
        value = value[key]
    return value


def option(container, name):
    return container["args"][container["args"].index(name) + 1]


class Manifests(unittest.TestCase):
    def setUp(self):
        self.jobs = [job for path in MANIFESTS for job in jobs_of(path)]
        self.assertGreaterEqual(len(self.jobs), 2)

    def test_are_jobs(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)
        for job in self.jobs:
            self.assertEqual([error.message for error in VALIDATOR.iter_errors(job)], [])

    def test_agree_with_themselves(self):
        for job in self.jobs:
            pod = job["spec"]["template"]["spec"]
            volumes = {volume["name"] for volume in pod["volumes"]}
            names = {container["name"] for container in pod["containers"]}
            for container in pod["containers"]:
                self.assertLessEqual({mount["name"] for mount in container["volumeMounts"]}, volumes)
                self.assertTrue(option(container, "--out").startswith(container["volumeMounts"][0]["mountPath"]))
            for rule in job["spec"].get("podFailurePolicy", {}).get("rules", []):
                self.assertIn(rule.get("onExitCodes", {}).get("containerName", next(iter(names))), names)

    def test_start_scripts_that_exist_with_as_many_shards_as_there_are_pods(self):
        for path in MANIFESTS:
            shards, merge = jobs_of(path)
            shard, merger = (job["spec"]["template"]["spec"]["containers"][0] for job in (shards, merge))
            for container in (shard, merger):
                script = ROOT / container["command"][0].removeprefix("/filament/")
                self.assertTrue(script.is_file(), script)
                self.assertEqual(container["image"], IMAGE)
            self.assertEqual(shards["spec"]["completionMode"], "Indexed")
            self.assertEqual(option(shard, "--shards"), str(shards["spec"]["completions"]))
            self.assertGreaterEqual(shards["spec"]["backoffLimitPerIndex"], int(option(shard, "--attempts")))
            for name in ("--out", "--tool", "--shards", "--attempts"):
                self.assertEqual(option(shard, name), option(merger, name))
            self.assertGreater(merge["spec"]["activeDeadlineSeconds"], int(option(merger, "--wait")))


class Image(unittest.TestCase):
    def test_has_the_name_of_the_manifests(self):
        self.assertIn(f"build -t {IMAGE} .", CONTAINERFILE)

    def test_has_what_the_manifests_start_and_what_that_reads(self):
        copied = re.findall(r"^COPY (\S+) /filament/\1$", CONTAINERFILE, re.MULTILINE)
        for path in (job["spec"]["template"]["spec"]["containers"][0]["command"][0] for path in MANIFESTS for job in jobs_of(path)):
            self.assertIn(path.split("/")[2], copied)
        self.assertIn("tests/conformance", copied)
        for path in copied:
            self.assertTrue((ROOT / path).is_dir(), path)


class Schema(unittest.TestCase):
    def refuses(self, job, edit, *path):
        changed = copy.deepcopy(job)
        edit(parent_of(changed, path), path[-1])
        return not VALIDATOR.is_valid(changed)

    def test_refuses_every_misspelt_field(self):
        def misspell(parent, key):
            parent[key[:-1] + ("x" if key[-1] != "x" else "y")] = parent.pop(key)

        free = ("labels",)
        for job in (job for path in MANIFESTS for job in jobs_of(path)):
            for path in places(job):
                if isinstance(path[-1], str) and not (len(path) > 1 and path[-2] in free):
                    self.assertTrue(self.refuses(job, misspell, *path), path)

    def test_refuses_every_value_of_another_type(self):
        def other_type(parent, key):
            parent[key] = str(parent[key]) + "!" if isinstance(parent[key], int) else 3.5

        for job in (job for path in MANIFESTS for job in jobs_of(path)):
            for path in places(job):
                self.assertTrue(self.refuses(job, other_type, *path), path)

    def test_refuses_what_contradicts_itself(self):
        job = jobs_of(MANIFESTS[0])[0]

        def remove(parent, key):
            del parent[key]

        def set_to(value):
            return lambda parent, key: parent.__setitem__(key, value)

        for edit, path in ((remove, ("spec", "completions")), (remove, ("spec", "completionMode")),
                           (remove, ("spec", "backoffLimitPerIndex")), (remove, ("spec", "template")),
                           (remove, ("spec", "template", "spec", "restartPolicy")),
                           (set_to("Always"), ("spec", "template", "spec", "restartPolicy")),
                           (set_to(-1), ("spec", "completions")), (set_to("batch/v2"), ("apiVersion",)),
                           (set_to("2 Gi"), ("spec", "template", "spec", "containers", 0, "resources", "limits", "memory")),
                           (set_to("Shard_1"), ("spec", "template", "spec", "containers", 0, "name")),
                           (set_to({"action": "Retry"}), ("spec", "podFailurePolicy", "rules", 0))):
            self.assertTrue(self.refuses(job, edit, *path), path)

    def test_refuses_an_added_field_anywhere(self):
        random.seed(1)
        job = jobs_of(MANIFESTS[0])[0]
        for path in places(job):
            inner = parent_of(job, path)[path[-1]]
            if isinstance(inner, dict) and path[-1] != "labels":
                def add(parent, key):
                    parent[key]["surprise"] = random.random()
                self.assertTrue(self.refuses(job, add, *path), path)

    def test_a_key_may_not_be_there_twice(self):
        with self.assertRaises(yaml.YAMLError):
            yaml.load("a: 1\na: 2\n", Loader=StrictLoader)


if __name__ == "__main__":
    unittest.main()
