"""What others on the machine or on a page elsewhere may try against `ifov view`, and what it answers."""

import pathlib
import re
import signal
import socket
import subprocess
import time
import unittest

from viewing import PROGRAM, ROOT, Refused, Scratch, Viewer, run, write_products

SECRET = "B1"  # in every answer that gives away what is the user's


class Attacks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = Scratch()
        cls.folder = cls.scratch.__enter__()
        write_products(cls.folder / "out")
        (cls.folder / "secret.txt").write_text("SECRET OF THE USER")
        cls.viewer = Viewer(cls.folder / "out", "--no-browser")

    @classmethod
    def tearDownClass(cls):
        cls.viewer.end()
        cls.scratch.__exit__()

    def refused(self, expected, *arguments, **named):
        status, headers, body = self.viewer.request(*arguments, **named)
        self.assertEqual(status, expected, body)
        self.assertNotIn(SECRET.encode(), body)
        self.assertNotIn(b"SECRET", body)
        return body.decode()

    def test_the_user_is_answered(self):
        status, headers, body = self.viewer.request("/api/sources")
        self.assertEqual(status, 200)
        self.assertIn(SECRET.encode(), body)

    def test_1_no_token_and_a_wrong_one(self):
        for token in (False, "", "0" * 32, self.viewer.token[:-1], self.viewer.token + "0", self.viewer.token.upper() + "x"):
            self.assertIn("token is missing or wrong", self.refused(403, "/api/sources", token=token))
        self.refused(403, f"/api/sources?token={self.viewer.token}", token=False)
        self.refused(403, "/api/sources", token=False, headers={"Cookie": f"token={self.viewer.token}"})

    def test_2_tokens_are_random_and_of_128_bits(self):
        with Viewer(self.folder / "out", "--no-browser") as other:
            self.assertRegex(other.token, r"^[0-9a-f]{32}$")
            self.assertNotEqual(other.token, self.viewer.token)
            self.assertNotEqual(other.port, self.viewer.port)

    def test_3_a_name_that_was_turned_to_this_machine(self):
        for host in ("attacker.example", f"attacker.example:{self.viewer.port}", "127.0.0.1.attacker.example", "127.attacker.example",
                     "localhost.attacker.example", "10.0.0.1", ""):
            self.assertIn("meant for another host", self.refused(421, "/api/sources", host=host or " "))
            self.refused(421, "/", host=host or " ")
        self.refused(421, "/api/sources", headers={"Host": "attacker.example"})
        self.assertEqual(self.viewer.request("/api/sources", host="localhost:8080")[0], 200)

    def test_4_a_page_of_another_site(self):
        for origin in ("http://attacker.example", "null", f"http://127.0.0.1:{self.viewer.port + 1}", f"https://127.0.0.1:{self.viewer.port}"):
            self.refused(403, "/api/sources", headers={"Origin": origin})
        for site in ("cross-site", "same-site"):
            self.refused(403, "/api/sources", headers={"Sec-Fetch-Site": site})
            self.refused(403, "/main.js", headers={"Sec-Fetch-Site": site})
        status, headers, _ = self.viewer.request("/api/sources", headers={"Origin": f"http://127.0.0.1:{self.viewer.port}", "Sec-Fetch-Site": "same-origin"})
        self.assertEqual(status, 200)
        self.assertNotIn("Access-Control-Allow-Origin", headers)

    def test_5_paths_out_of_the_page(self):
        for path in ("/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/web/main.js", "//etc/passwd", "/api/../../secret.txt",
                     f"/{self.folder}/secret.txt", "/style.css/../../secret.txt", "/index.html%00.txt", "/api/", "/api/nothing"):
            self.refused(404, path)

    def test_6_names_that_are_paths(self):
        query = "source=0&generation=1&band=0&x0=0&y0=0&x1=2&y1=2&step=1&cube="
        for name in ("../../secret.txt", "%2e%2e%2fsecret", "/etc/passwd", "radiance.img", "radiance%00", "image_radiance", ""):
            self.refused(404, f"/api/band?{query}{name}")
        self.assertEqual(self.viewer.request(f"/api/band?{query}radiance")[0], 200)
        for corners in ("mask:/etc/passwd", "map:0,0,1,1", "../secret"):
            self.refused(400, f"/api/region?source=0&generation=1&corners={corners}")

    def test_7_numbers_out_of_range(self):
        good = {"source": 0, "generation": 1, "cube": "radiance", "band": 0, "x0": 0, "y0": 0, "x1": 2, "y1": 2, "step": 1}
        for key, value in (("band", 6), ("band", -1), ("x0", -1), ("x1", 25), ("y1", 17), ("x1", 0), ("step", 0), ("source", 1), ("source", -1),
                           ("band", "1e3"), ("band", "0x1"), ("band", "99999999999999999999"), ("band", ""), ("band", " 1"), ("step", 2**31)):
            with self.assertRaises(Refused) as refused:
                self.viewer.ask("band", **{**good, key: value})
            self.assertEqual(refused.exception.status, 400)
            self.assertIn(f"'{key}' is '{value}'; expected a whole number from", refused.exception.why)
        with self.assertRaisesRegex(Refused, "400: the request does not say 'band'"):
            self.viewer.ask("band", **{k: v for k, v in good.items() if k != "band"})
        for x, y in ((24, 0), (0, 16), (-1, 0)):
            with self.assertRaises(Refused):
                self.viewer.ask("pixel", source=0, generation=1, x=x, y=y)
        with self.assertRaisesRegex(Refused, "expected 'bands', 'pca' or 'mnf'"):
            self.viewer.ask("projection", source=0, generation=1, kind="<b>")

    def test_8_only_reading(self):
        for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "HEAD"):
            status, _, _ = self.viewer.request("/api/sources", method=method, body=b"x" if method in ("POST", "PUT", "PATCH") else None)
            self.assertEqual(status, 405, method)

    def test_8_what_stops_a_run_is_posted_by_the_page_alone(self):
        state = self.folder / "out/run.part"
        for expected, named in ((405, {"method": "GET"}), (403, {"method": "POST", "token": False}),
                                (403, {"method": "POST", "headers": {"Origin": "http://attacker.example"}}),
                                (403, {"method": "POST", "headers": {"Sec-Fetch-Site": "cross-site"}}),
                                (409, {"method": "POST"})):
            self.refused(expected, "/api/stop?source=0", **named)
            self.assertFalse(state.exists())

    def test_9_replies_forbid_what_is_not_from_here(self):
        for path in ("/", "/main.js", "/api/sources", "/nothing"):
            _, headers, _ = self.viewer.request(path)
            policy = headers["Content-Security-Policy"]
            self.assertIn("default-src 'none'", policy)
            self.assertNotIn("unsafe", policy)
            self.assertIn("frame-ancestors 'none'", policy)
            self.assertIn("require-trusted-types-for 'script'", policy)
            self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
            self.assertEqual(headers["Referrer-Policy"], "no-referrer")
            self.assertEqual(headers["Cache-Control"], "no-store")
            self.assertNotIn("Set-Cookie", headers)

    def test_10_text_is_never_markup(self):
        bad = re.compile(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\b|new Function|setTimeout\(\s*[\"'`]|createContextualFragment|\bsrcdoc\b|DOMParser|\.on\w+\s*=[^=>]")
        for file in sorted((ROOT / "web").glob("*.js")):
            self.assertEqual(bad.findall(file.read_text()), [], file.name)
        self.assertTrue(bad.search('e.innerHTML = "x"') and bad.search("e.onclick = f"))
        page = (ROOT / "web/index.html").read_text()
        self.assertEqual(re.findall(r"<script(?![^>]*\bsrc=)|\bstyle=|<style|\bon\w+=|https?:", page), [])
        self.assertEqual(self.viewer.request("/api/band?source=%3Cscript%3E")[1]["Content-Type"], "application/json")

    def test_11_requests_that_are_too_large_or_never_end(self):
        def send(*pieces):
            with socket.create_connection((self.viewer.host, self.viewer.port), timeout=20) as connection:
                try:
                    for piece in pieces:
                        connection.sendall(piece)
                    connection.shutdown(socket.SHUT_WR)
                    return connection.recv(200)
                except OSError:
                    return b""
        head = f"GET /api/sources HTTP/1.1\r\nHost: 127.0.0.1\r\n".encode()
        for request in ((b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n",), (head, *[b"X: " + b"y" * 4000 + b"\r\n"] * 200), (head, *[b"a: b\r\n"] * 20000),
                        (b"\0" * 100000,), (b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\n", *[b"ffff\r\n" + b"z" * 65535 + b"\r\n"] * 50)):
            self.assertNotIn(b" 200 ", send(*request))
        self.refused(400, "/api/sources", headers={"Range": "bytes=" + ",".join(["0-"] * 1000)})
        with self.assertRaisesRegex(Refused, "'corners' has .* bytes; expected 6000 at most"):
            self.viewer.ask("region", source=0, generation=1, corners="1" * 6500)

    def test_12_clients_that_say_nothing(self):
        silent = [socket.create_connection((self.viewer.host, self.viewer.port)) for _ in range(40)]
        try:
            dripping = socket.create_connection((self.viewer.host, self.viewer.port))
            dripping.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ")
            begin = time.monotonic()
            self.assertEqual(self.viewer.request("/api/sources")[0], 200)
            self.assertLess(time.monotonic() - begin, 20)
        finally:
            for connection in silent:
                connection.close()
            dripping.close()

    def test_listens_to_this_machine_alone(self):
        listening = subprocess.run(["cat", "/proc/net/tcp"], capture_output=True, text=True).stdout
        ours = [line.split()[1] for line in listening.splitlines()[1:] if line.split()[1].endswith(f":{self.viewer.port:04X}") and line.split()[3] == "0A"]
        self.assertEqual(ours, [f"0100007F:{self.viewer.port:04X}"])


class Starting(unittest.TestCase):
    def test_other_addresses_need_a_token_file(self):
        with Scratch() as folder:
            write_products(folder / "out")
            answer = run("view", folder / "out", "--no-browser", "--listen", "192.0.2.1")
            self.assertEqual(answer.returncode, 1)
            self.assertIn("--listen 192.0.2.1: others reach this address; --token-file FILE must hold a token", answer.stderr)
            token = folder / "token"
            token.write_text("0123456789abcdef0123456789abcdef\n")
            token.chmod(0o644)
            answer = run("view", folder / "out", "--no-browser", "--token-file", token)
            self.assertEqual(answer.returncode, 1)
            self.assertIn("others may read this file", answer.stderr)
            token.chmod(0o600)
            with Viewer(folder / "out", "--no-browser", "--token-file", token) as viewer:
                self.assertEqual(viewer.token, "0123456789abcdef0123456789abcdef")
                self.assertEqual(viewer.request("/api/sources")[0], 200)
            answer = run("view", folder / "out", "--no-browser", "--listen", "192.0.2.1", "--token-file", token)
            self.assertEqual(answer.returncode, 2)
            self.assertIn("cannot listen at 192.0.2.1", answer.stderr)
            answer = run("view", folder / "out", "--no-browser", "--listen", "0.0.0.0", "--token-file", token)
            self.assertEqual(answer.returncode, 1)
            self.assertIn("expected one address of this machine", answer.stderr)
            for text in ("short\n", "0123456789abcdef 0123456789abcdef\n", ""):
                token.write_text(text)
                answer = run("view", folder / "out", "--no-browser", "--token-file", token)
                self.assertEqual(answer.returncode, 1)
                self.assertIn("expected one line of 22 to 128 letters", answer.stderr)

    def test_ctrl_c_and_termination_end_it(self):
        with Scratch() as folder:
            write_products(folder / "out")
            for signal_number in (signal.SIGINT, signal.SIGTERM):
                viewer = Viewer(folder / "out", "--no-browser")
                idle = socket.create_connection((viewer.host, viewer.port))
                begin = time.monotonic()
                code, out, err = viewer.end(signal_number)
                self.assertEqual((code, err), (0, ""))
                self.assertIn("Ctrl-C ends it", out)
                self.assertLess(time.monotonic() - begin, 5)
                idle.close()

    def test_what_cannot_be_shown_is_said(self):
        with Scratch() as folder:
            for arguments, code, text in ((["nowhere"], 2, "there is no 'nowhere'"), ([], 1, "WHAT is required")):
                answer = subprocess.run([PROGRAM, "view", *arguments], cwd=folder, capture_output=True, text=True, timeout=60)
                self.assertEqual(answer.returncode, code)
                self.assertIn(text, answer.stderr)
            write_products(folder / "out")
            (folder / "scene.json").write_text("{}")
            answer = run("view", folder / "out", folder / "scene.json")
            self.assertIn("expected a document alone, or one or two folders of products", answer.stderr)
            answer = run("view", folder / "out", "--inputs-below", folder / "out", "--token-file", folder / "scene.json")
            self.assertIn("--inputs-below", answer.stderr)

    def test_the_bundle_is_fresh_and_small(self):
        files = sorted((ROOT / "web").iterdir())
        self.assertLess(sum(f.stat().st_size for f in files), 150_000)
        with Scratch() as folder:
            write_products(folder / "out")
            with Viewer(folder / "out", "--no-browser") as viewer:
                for file in files:
                    path = "/" if file.name == "index.html" else f"/{file.name}"
                    status, headers, body = viewer.request(path, token=False)
                    self.assertEqual(status, 200, path)
                    self.assertEqual(body, file.read_bytes(), path)
                    kind = {".html": "text/html", ".js": "text/javascript", ".css": "text/css"}[file.suffix]
                    self.assertEqual(headers["Content-Type"], f"{kind}; charset=utf-8")


if __name__ == "__main__":
    unittest.main()
