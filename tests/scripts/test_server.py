#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""filament-server from outside: answers, errors, a full queue, time limits, workers that are killed, a server that is
killed in the middle of its jobs, many clients at once, metrics, OpenAPI, and tools over standard input.

  test_server.py PROGRAM [--requests N] [--clients N]     prints the figures of the load test
"""
import argparse
import atexit
import base64
import concurrent.futures
import http.client
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

SCENE = {"points": [{"at": [0, 1, 1], "candela": 500}], "view": {"clear": [0.2, 0.4, 0.6, 1]}}
PNG = b"\x89PNG\r\n\x1a\n"


class Server:
    def __init__(self, program, spool, *options):
        self.process = subprocess.Popen([program, "--spool", spool, "--port", "0", *options], stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)
        atexit.register(self.process.kill)  # after a failure, too
        line = self.process.stdout.readline()
        assert line.startswith("http://127.0.0.1:"), line
        self.port = int(line.rsplit(":", 1)[1])

    def request(self, method, path, body=None, timeout=120):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            connection.request(method, path, body if body is None or isinstance(body, (str, bytes)) else json.dumps(body))
            response = connection.getresponse()
            return response.status, response.read(), dict(response.getheaders())
        finally:
            connection.close()

    def job(self, name):
        return json.loads(self.request("GET", f"/v1/jobs/{name}")[1])

    def wait(self, name, seconds=120):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            job = self.job(name)
            if job.get("status") in ("done", "failed"):
                return job
            time.sleep(0.02)
        raise AssertionError(f"{name} is not done: {job}")

    def metric(self, name):
        text = self.request("GET", "/metrics")[1].decode()
        return float(re.search(rf"^{re.escape(name)} (\S+)$", text, re.M)[1])

    def workers(self):
        children = pathlib.Path(f"/proc/{self.process.pid}/task").glob("*/children")
        return [int(child) for file in children for child in file.read_text().split()]

    def end(self, how=signal.SIGTERM):
        self.process.send_signal(how)
        status = self.process.wait(30)
        self.process.stdout.close()
        return status


def runs(process):
    """A process that nobody waited for has ended, too."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
    except FileNotFoundError:
        return False


def expect_error(answer, status, part):
    assert answer[0] == status, answer
    error = json.loads(answer[1])["error"]
    assert part in error and "\n" not in error, error


def answers(program, folder):
    server = Server(program, folder, "--workers", "1", "--megapixels", "1", "--request-megabytes", "1")
    status, body, headers = server.request("POST", "/v1/render", {"scene": SCENE, "size": [32, 24]})
    assert status == 200 and body.startswith(PNG) and headers["Content-Type"] == "image/png", (status, body[:200])
    vulkan = server.request("POST", "/v1/render", {"scene": SCENE, "size": [32, 24], "api": "vulkan"})
    assert vulkan[0] == 200 and vulkan[1] == body, "the same bits from both APIs"
    exr = server.request("POST", "/v1/render", {"scene": SCENE, "size": [32, 24], "format": "exr"})
    assert exr[0] == 200 and exr[1][:4] == b"\x76\x2f\x31\x01" and exr[2]["Content-Type"] == "image/x-exr"
    expect_error(server.request("POST", "/v1/render", "{"), 400, "request")
    expect_error(server.request("POST", "/v1/render", {"scene": {"pionts": []}}), 400, "points")
    expect_error(server.request("POST", "/v1/render", {"scene": {"model": "/etc/passwd"}, "size": [8, 8]}), 400, "/etc/passwd")
    expect_error(server.request("POST", "/v1/render", {"scene": {}, "size": [2048, 2048]}), 400, "up to 1048576")
    expect_error(server.request("POST", "/v1/render", b" " * (1 << 21)), 413, "too large")
    expect_error(server.request("GET", "/v1/jobs/none"), 404, "no such job")
    expect_error(server.request("GET", "/v1/jobs/../x"), 404, "no such path")
    expect_error(server.request("GET", "/nothing"), 404, "openapi.json")
    assert server.request("POST", "/v1/check", {"scene": SCENE})[0] == 200
    # A job by its own name, twice.
    first = server.request("POST", "/v1/jobs", {"id": "mine", "scene": SCENE, "size": [32, 24]})
    again = server.request("POST", "/v1/jobs", {"id": "mine", "scene": SCENE, "size": [32, 24]})
    assert (first[0], again[0]) == (202, 202), (first, again)
    assert server.wait("mine")["status"] == "done"
    assert server.request("GET", "/v1/jobs/mine/image")[1] == body
    assert server.request("DELETE", "/v1/jobs/mine")[0] == 200
    expect_error(server.request("GET", "/v1/jobs/mine/image"), 404, "no such job")
    # Every path that it describes is there.
    api = json.loads(server.request("GET", "/openapi.json")[1])
    for path, methods in api["paths"].items():
        for method in set(methods) - {"parameters"}:
            status, text, _ = server.request(method.upper(), path.replace("{id}", "x"), b"" if method == "post" else None)
            assert b"no such path" not in text, (method, path, text)
            assert str(status) in methods[method]["responses"], (method, path, status)
    assert json.loads(server.request("GET", "/v1/schema")[1])["$schema"].startswith("https://json-schema.org/")
    assert server.metric('filament_requests_total{route="render",code="200"}') == 3
    assert server.metric("filament_workers_resident_bytes") > 1e6
    assert server.end() == 0


def hidden_paths(program, folder):
    """Errors of the loaders, of models that are missing, do not name the server's folders."""
    assets = pathlib.Path(folder, "assets")
    assets.mkdir()
    server = Server(program, folder + "/spool", "--workers", "1", "--assets", str(assets))
    answer = server.request("POST", "/v1/render", {"scene": {"model": "asset:none.glb"}, "size": [8, 8]})
    expect_error(answer, 400, "assets/none.glb")
    assert folder.encode() not in answer[1], answer
    assert server.end() == 0


def pressure(program, folder):
    """A queue of two behind one worker that is stopped."""
    server = Server(program, folder, "--workers", "1", "--queue", "2", "--wait", "1")
    server.request("POST", "/v1/render", {"scene": SCENE, "size": [8, 8]})
    worker = server.workers()[0]
    os.kill(worker, signal.SIGSTOP)
    codes = [server.request("POST", "/v1/jobs", {"id": f"p{i}", "scene": SCENE, "size": [8, 8]}) for i in range(4)]
    assert sorted(code[0] for code in codes).count(503) >= 1, codes
    full = next(code for code in codes if code[0] == 503)
    assert full[2]["Retry-After"] == "1"
    server.request("DELETE", "/v1/jobs/p1")
    late = server.request("POST", "/v1/render", {"id": "late", "scene": SCENE, "size": [8, 8]})
    assert late[0] in (503, 504), late
    os.kill(worker, signal.SIGCONT)
    for i, code in enumerate(codes):
        if code[0] == 202 and i != 1:
            assert server.wait(f"p{i}")["status"] == "done"
    assert server.end() == 0


def workers_end(program, folder):
    """A worker that is killed while it draws, and one that draws too long: others are not hurt."""
    server = Server(program, folder, "--workers", "2", "--limit", "2")
    server.request("POST", "/v1/render", {"scene": SCENE, "size": [8, 8]})
    # The first worker that gets it is stopped: it draws for ever.
    for worker in server.workers():
        os.kill(worker, signal.SIGSTOP)
    assert server.request("POST", "/v1/jobs", {"id": "slow", "scene": SCENE, "size": [8, 8]})[0] == 202
    os.kill(server.workers()[0], signal.SIGCONT)
    time.sleep(0.1)
    for worker in server.workers():
        os.kill(worker, signal.SIGCONT)
    assert server.wait("slow")["status"] == "done"
    heavy = {"id": "heavy", "size": [3000, 3000], "scene": {"points": SCENE["points"], "view": {"frames": 16, "samples": 4}}}
    assert server.request("POST", "/v1/jobs", heavy)[0] == 202
    light = server.request("POST", "/v1/render", {"scene": SCENE, "size": [8, 8]})
    assert light[0] == 200, light
    job = server.wait("heavy")
    assert job["status"] == "done" or "took longer than 2" in job["error"], job
    # Killed twice with the same job: that has failed, and nothing else.
    for worker in server.workers():
        os.kill(worker, signal.SIGKILL)
    assert server.request("POST", "/v1/render", {"scene": SCENE, "size": [8, 8]})[0] == 200
    assert server.metric("filament_worker_restarts") >= 2
    assert server.request("GET", "/health")[0] == 200
    assert server.end() == 0


def killed(program, folder, count=100):
    """Killed in the middle of its jobs, and started again: every accepted one is answered."""
    server = Server(program, folder, "--workers", "2", "--queue", "1000")
    server.request("POST", "/v1/render", {"scene": SCENE, "size": [8, 8]})
    names = [f"job{i}" for i in range(count)]
    workers = server.workers()
    for worker in workers:  # until all are accepted, on machines that draw faster than they accept
        os.kill(worker, signal.SIGSTOP)
    for name in names:
        assert server.request("POST", "/v1/jobs", {"id": name, "scene": SCENE, "size": [64, 48]})[0] == 202
    for worker in workers:
        os.kill(worker, signal.SIGCONT)
    while not any(server.job(name)["status"] == "done" for name in names[:5]):
        time.sleep(0.01)
    server.end(signal.SIGKILL)
    time.sleep(0.2)
    assert not any(runs(worker) for worker in workers), "workers end with their server"
    done = len(list(pathlib.Path(folder, "done").glob("*.json")))
    assert done < count, "it was too fast to be killed in the middle"
    server = Server(program, folder, "--workers", "2", "--queue", "1000")
    pictures = set()
    for name in names:
        assert server.wait(name)["status"] == "done"
        status, picture, _ = server.request("GET", f"/v1/jobs/{name}/image")
        assert status == 200
        pictures.add(picture)
    assert len(pictures) == 1, "the same picture each time"
    assert server.end() == 0
    print(f"killed after {done} of {count} jobs: all {count} answered after the restart")


def burst(program, folder, clients=64):
    """Connections that arrive while the server accepts none wait, and are answered."""
    server = Server(program, folder, "--workers", "1", "--threads", "4")
    server.process.send_signal(signal.SIGSTOP)
    connections = [http.client.HTTPConnection("127.0.0.1", server.port, timeout=20) for _ in range(clients)]
    for connection in connections:
        connection.connect()
        connection.request("GET", "/metrics", headers={"Connection": "close"})
    server.process.send_signal(signal.SIGCONT)
    for connection in connections:
        response = connection.getresponse()
        assert response.status == 200 and response.read()
        connection.close()
    assert server.end() == 0
    print(f"{clients} connections at once: all answered")


def load(program, folder, requests, clients):
    server = Server(program, folder, "--workers", "2", "--threads", str(clients + 8), "--queue", "1000")
    first = server.request("POST", "/v1/render", {"scene": SCENE, "size": [64, 48]})
    assert first[0] == 200

    def one(i):
        begin = time.monotonic()
        broken = i % 50 == 49
        body = {"scene": {"points": 1}} if broken else {"scene": SCENE, "size": [64, 48]}
        status, picture, _ = server.request("POST", "/v1/render", body)
        assert status == (400 if broken else 200), (i, status, picture[:200])
        assert broken or picture == first[1], i
        return time.monotonic() - begin

    memory = []
    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(clients) as pool:
        jobs = []
        for part in range(10):
            share = range(part * requests // 10, (part + 1) * requests // 10)
            jobs += pool.map(one, share)
            memory.append((server.metric("filament_resident_bytes") + server.metric("filament_workers_resident_bytes")) / 2**20)
    seconds = time.monotonic() - begin
    jobs.sort()
    assert len(jobs) == requests
    assert memory[-1] < 1.1 * memory[1] + 16, memory
    print(f"{requests} requests from {clients} clients: {requests / seconds:.0f} a second, median {jobs[len(jobs) // 2] * 1e3:.0f} ms, "
          f"p99 {jobs[int(len(jobs) * 0.99)] * 1e3:.0f} ms; none lost; memory {memory[0]:.0f}, {memory[4]:.0f}, {memory[-1]:.0f} MiB")
    assert server.end() == 0


def tools(program, folder):
    process = subprocess.Popen([program, "--spool", folder, "--workers", "1", "--mcp"], stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    atexit.register(process.kill)

    def call(message):
        process.stdin.write((message if isinstance(message, str) else json.dumps(message)) + "\n")
        process.stdin.flush()
        return json.loads(process.stdout.readline())

    def rpc(method, parameters=None, number=1):
        return call({"jsonrpc": "2.0", "id": number, "method": method, "params": parameters or {}})

    start = rpc("initialize", {"protocolVersion": "2025-03-26", "capabilities": {}, "clientInfo": {"name": "t", "version": "1"}})
    assert start["result"]["serverInfo"]["name"] == "filament-server", start
    process.stdin.write('{"jsonrpc": "2.0", "method": "notifications/initialized"}\n')
    names = [tool["name"] for tool in rpc("tools/list", number="two")["result"]["tools"]]
    assert names == ["render_scene", "check_scene", "scene_schema"], names
    drawn = rpc("tools/call", {"name": "render_scene", "arguments": {"scene": SCENE, "size": [16, 16]}})["result"]
    assert not drawn["isError"] and base64.b64decode(drawn["content"][0]["data"]).startswith(PNG)
    wrong = rpc("tools/call", {"name": "check_scene", "arguments": {"scene": {"point": []}}})["result"]
    assert wrong["isError"] and "points" in wrong["content"][0]["text"], wrong
    assert "$schema" in rpc("tools/call", {"name": "scene_schema"})["result"]["content"][0]["text"]
    assert rpc("tools/call", {"name": "none"})["error"]["code"] == -32602
    assert rpc("nothing")["error"]["code"] == -32601
    assert call("{")["error"]["code"] == -32700
    assert call('{"jsonrpc": 2, "id": 1, "method": 3}')["error"]["code"] == -32600
    assert rpc("ping")["result"] == {}
    process.stdin.close()
    assert process.wait(30) == 0
    process.stdout.close()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--requests", type=int, default=200)
    parser.add_argument("--clients", type=int, default=32)
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    for check in (answers, hidden_paths, pressure, workers_end, killed, burst, tools):
        with tempfile.TemporaryDirectory() as folder:
            check(program, folder)
    with tempfile.TemporaryDirectory() as folder:
        load(program, folder, options.requests, options.clients)
    with tempfile.TemporaryDirectory() as folder: # two servers cannot have one folder
        server = Server(program, folder)
        second = subprocess.run([program, "--spool", folder, "--port", "0"], capture_output=True, text=True, timeout=60)
        assert second.returncode == 1 and "another server has this folder" in second.stderr, second
        busy = subprocess.run([program, "--spool", folder + "/b", "--port", str(server.port)], capture_output=True, text=True,
                              timeout=60)
        assert busy.returncode == 1 and "another --port" in busy.stderr, busy
        assert server.end() == 0


if __name__ == "__main__":
    sys.exit(main())
