//! A headless Chromium, driven from tests through its debugging protocol.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, ErrorKind};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tungstenite::{Error, Message, WebSocket, client};

/// The longest that anything may take.
const PATIENCE: Duration = Duration::from_secs(300);

/// A browser with one page.
pub struct Browser {
    child: Child,
    socket: WebSocket<TcpStream>,
    session: String,
    calls: u64,
    profile: PathBuf,
    /// Errors and everything on the console since the page was opened.
    pub complaints: Vec<String>,
}

/// How a reader likes pages.
#[derive(Clone, Copy, Debug)]
pub struct Reader {
    pub width: u32,
    pub dark: bool,
    pub reduced_motion: bool,
}

impl Browser {
    /// Starts the Chromium of this machine without any graphics; says so if there is none.
    pub fn start() -> Option<Self> {
        Self::found(&["--disable-gpu"])
    }

    /// The same with WebGL, done by the processor.
    pub fn with_webgl() -> Option<Self> {
        Self::found(&["--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
    }

    fn found(graphics: &[&str]) -> Option<Self> {
        let names = ["chromium", "chromium-browser", "google-chrome"];
        let paths = std::env::var_os("PATH")?;
        let folders: Vec<PathBuf> = std::env::split_paths(&paths).collect();
        let mut found = names
            .iter()
            .flat_map(|name| folders.iter().map(move |f| f.join(name)));
        let Some(program) = found.find(|path| path.is_file()) else {
            println!("skipped: there is no chromium on this machine");
            return None;
        };
        Some(Self::of(&program, graphics))
    }

    fn of(program: &Path, graphics: &[&str]) -> Self {
        let profile = std::env::temp_dir().join(format!(
            "lagrange-browser-{}-{:?}",
            std::process::id(),
            std::thread::current().id()
        ));
        let mut child = Command::new(program)
            .args([
                "--headless",
                "--no-sandbox",
                "--no-first-run",
                "--remote-debugging-port=0",
            ])
            .args(graphics)
            .arg(format!("--user-data-dir={}", profile.display()))
            .stderr(Stdio::piped())
            .stdout(Stdio::null())
            .spawn()
            .expect("the browser starts");
        let lines = BufReader::new(child.stderr.take().expect("its words")).lines();
        let address = lines
            .map_while(Result::ok)
            .find_map(|line| {
                line.strip_prefix("DevTools listening on ")
                    .map(str::to_owned)
            })
            .expect("the address of its debugger");
        let host = address
            .trim_start_matches("ws://")
            .split('/')
            .next()
            .expect("a host");
        let stream = TcpStream::connect(host).expect("the debugger");
        stream.set_read_timeout(Some(PATIENCE)).expect("a socket");
        let (socket, _) = client(address.as_str(), stream).expect("a web socket");
        let mut browser = Self {
            child,
            socket,
            session: String::new(),
            calls: 0,
            profile,
            complaints: Vec::new(),
        };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attached = json!({ "targetId": target["targetId"], "flatten": true });
        let session = browser.call("Target.attachToTarget", attached)["sessionId"].clone();
        browser.session = session.as_str().expect("a session").to_owned();
        for domain in ["Page", "Runtime", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// Asks for something that is answered.
    fn call(&mut self, method: &str, params: Value) -> Value {
        let answer = self.ask(method, params);
        answer.unwrap_or_else(|refused| panic!("{method}: {refused}"))
    }

    /// Asks for something and waits for the answer, or why there is none; what the page complains of meanwhile is kept.
    fn ask(&mut self, method: &str, params: Value) -> Result<Value, Value> {
        self.calls += 1;
        let mut message = json!({ "id": self.calls, "method": method, "params": params });
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        self.socket
            .send(Message::text(message.to_string()))
            .expect("a connection");
        loop {
            let text = match self.socket.read() {
                Ok(Message::Text(text)) => text,
                Ok(_) => continue,
                // A signal to this process is no answer.
                Err(Error::Io(error)) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => panic!("{method}: {error}"),
            };
            let answer: Value = serde_json::from_str(&text).expect("JSON");
            let said = [
                "Runtime.exceptionThrown",
                "Runtime.consoleAPICalled",
                "Log.entryAdded",
            ];
            if said.iter().any(|event| answer["method"] == *event) {
                self.complaints.push(answer["params"].to_string());
            }
            if answer["id"] == self.calls {
                return match &answer["error"] {
                    Value::Null => Ok(answer["result"].clone()),
                    refused => Err(refused.clone()),
                };
            }
        }
    }

    /// Opens a file as a reader likes it; gives the time until everything was there, ms.
    pub fn open(&mut self, path: &Path, reader: Reader) -> f64 {
        let metrics = json!({
            "width": reader.width, "height": 844, "deviceScaleFactor": 1, "mobile": reader.width < 600,
        });
        self.call("Emulation.setDeviceMetricsOverride", metrics);
        let scheme = if reader.dark { "dark" } else { "light" };
        let motion = if reader.reduced_motion {
            "reduce"
        } else {
            "no-preference"
        };
        let features = json!({ "features": [
            { "name": "prefers-color-scheme", "value": scheme },
            { "name": "prefers-reduced-motion", "value": motion },
        ]});
        self.call("Emulation.setEmulatedMedia", features);
        self.complaints.clear();
        self.call(
            "Page.navigate",
            json!({ "url": format!("file://{}", path.display()) }),
        );
        let loaded = "document.readyState === 'complete' && location.protocol === 'file:' \
                      ? (performance.getEntriesByType('navigation')[0]?.loadEventEnd ?? 1) : 0";
        self.wait(loaded).as_f64().expect("a time")
    }

    /// The value of an expression in the page.
    pub fn evaluate(&mut self, script: &str) -> Value {
        let value = self.value(script);
        value.unwrap_or_else(|refused| panic!("{script}: {refused}"))
    }

    /// The value of an expression, or why the page does not tell it.
    fn value(&mut self, script: &str) -> Result<Value, Value> {
        let params = json!({ "expression": script, "returnByValue": true, "awaitPromise": true });
        let answer = self.ask("Runtime.evaluate", params)?;
        assert_eq!(answer["exceptionDetails"], Value::Null, "{script}");
        Ok(answer["result"]["value"].clone())
    }

    /// Reads the page once more.
    pub fn reload(&mut self) {
        self.evaluate("window.isLeft = true");
        self.call("Page.reload", json!({}));
        self.wait("!window.isLeft && document.readyState === 'complete'");
    }

    /// Waits until an expression is neither 0, false nor empty. A page that is being left tells nothing.
    pub fn wait(&mut self, script: &str) -> Value {
        let begin = Instant::now();
        loop {
            let value = self.value(script).unwrap_or_default();
            let empty = [json!(0), json!(false), json!(""), Value::Null];
            if !empty.contains(&value) && value.as_f64() != Some(0.0) {
                return value;
            }
            assert!(begin.elapsed() < PATIENCE, "still waiting for {script}");
            sleep(Duration::from_millis(10));
        }
    }

    /// Presses and releases a key.
    pub fn press(&mut self, key: &str) {
        let text = if key == " " { " " } else { "" };
        for kind in [
            if text.is_empty() {
                "rawKeyDown"
            } else {
                "keyDown"
            },
            "keyUp",
        ] {
            let event = json!({ "type": kind, "key": key, "text": if kind == "keyDown" { text } else { "" } });
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Clicks at a part, from 0 to 1, of the width of the first element that a selector finds.
    pub fn click(&mut self, selector: &str, part: f64) {
        let place = self.evaluate(&format!(
            "(() => {{ const e = document.querySelector('{selector}'); e.scrollIntoView({{ block: 'center' }}); \
             const b = e.getBoundingClientRect(); return [b.left + {part} * b.width, b.top + b.height / 2]; }})()"
        ));
        for kind in ["mousePressed", "mouseReleased"] {
            let event = json!({ "type": kind, "x": place[0], "y": place[1], "button": "left", "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", event);
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_dir_all(&self.profile);
    }
}
